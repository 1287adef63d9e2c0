#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "scene/window/desktop.h"

/// One function a subcommand of `palpa`: adds it to the program with its options, examples and
/// action. Actions throw UsageError (exit code 2) or Error (1).
namespace palpa::cli {

/// All of them, with the program's own name, options and help.
void addCommands(CLI::App& program);

/// Reads the words after the program's name and does what they say; the exit code. Mistakes in
/// them are told, what an action throws comes through.
int runCommand(std::vector<std::string> words);

/// `palpa subclavian`; also by the name of before, which every dictionary gives to a tap of the
/// abdomen.
inline constexpr const char* kNameOfBefore = "paracentesis";
void addSubclavian(CLI::App& program);
void addPalpation(CLI::App& program);
void addSqueeze(CLI::App& program);
void addFriction(CLI::App& program);
void addPulse(CLI::App& program);
void addSearch(CLI::App& program);
void addTrain(CLI::App& program);  ///< any of them, by the task file
void addReplay(CLI::App& program);
void addFinish(CLI::App& program);  ///< what a session owes whose program died
void addCalibrate(CLI::App& program);
void addPatient(CLI::App& program);
void addRender(CLI::App& program);
void addBoard(CLI::App& program);
void addPhantom(CLI::App& program);
void addExport(CLI::App& program);
void addRecords(CLI::App& program);   ///< trainees and their trials
void addStudy(CLI::App& program);     ///< a protocol's sessions, who is where in it
void addCampaign(CLI::App& program);  ///< simulated sessions by the thousand
void addRate(CLI::App& program);      ///< human raters
void addReport(CLI::App& program);    ///< pages of a trainee or a group
void addDoctor(CLI::App& program);    ///< is the station well?
void addConsole(CLI::App& program);   ///< the educator's pages
void addBench(CLI::App& program);
void addManual(
    CLI::App& program,
    const std::string& welcome);  ///< manual page and completion, from all that were added before

/// `palpa console` with nothing said: what `palpa` alone does where there is a display.
void runConsole();

/// `palpa report trial`: one trial of a needle session, judged, as a page.
void addReportTrial(CLI::App& report);
void addReportCertificate(CLI::App& report);

/// camera, tool, workspace, registration, latency, force-sensor, material, friction, inclusion,
/// all.
void addStationCalibrations(CLI::App& calibrate);

/// subtasks: a task's parts proposed from recorded sessions.
void addSubtaskCalibration(CLI::App& calibrate);

/// procedures: the library of interactive procedures from recorded sessions.
void addProcedureCalibration(CLI::App& calibrate);
/// Parts of recorded tasks by that library: page and JSON in a folder, words on standard output.
/// Empty names: the shipped library, a folder of its own.
void proposeByLibrary(const std::vector<std::string>& recordings, const std::string& library,
                      const std::string& out);

/// experts: the expert path from recorded trials.
void addExpertCalibration(CLI::App& calibrate);
void addExpertRanges(CLI::App& calibrate);

/// `palpa console learning`: cmi5 and LTI 1.3.
void addLearning(CLI::App& console);

/// `palpa study analyse`: tables, figures and a page of a study from its records.
void addStudyAnalyse(CLI::App& study);

/// `palpa study plan`: what a study of some size would find, from the learning model alone.
void addStudyPlan(CLI::App& study);

/// How a recorded trial is to be seen.
struct ReplayViewOptions {
  bool view = false;
  bool show_map = true;           ///< of what was felt, where the session has one
  std::string video;              ///< film to write
  std::string pictures;           ///< folder for single pictures; both empty: a window
  std::string figures;            ///< folder for figures of a search's floor
  std::string size = "1280x720";  ///< of film and pictures
  scene::WindowPlace window = {};
  int trial = 0;                            ///< 0: the first that was finished
  double speed = 1, from_s = 0, to_s = -1;  ///< of the trial; -1: to its end
  double frames_per_second = 25;
  bool wanted() const { return view || !video.empty() || !pictures.empty(); }
};

void addReplayViewOptions(CLI::App& command, ReplayViewOptions& options);

/// Plays a trial of any task's session in a window, or writes it as a film or as single pictures.
/// Throws UsageError for a trial that is not there, Error where there is no display.
void viewReplay(const std::string& file, const ReplayViewOptions& options);
/// Stimulus, texture, response and way of a search's episode into `options.figures`. Throws Error.
void writeReplayFigures(const std::string& file, const ReplayViewOptions& options);

}  // namespace palpa::cli
