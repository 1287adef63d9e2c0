#include <cstdio>
#include <memory>

#include "anatomy/base/error.h"
#include "apps/calibrate/subtask_page.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"

namespace palpa::cli {
namespace {

constexpr const char* kSubtaskExamples = R"(Examples:
  palpa calibrate subtasks out/expert-a/session.palpa out/expert-b/session.palpa --out parts
      the interactive procedures that the library recognises, with the cue that it maps to each, and
      how they agree with the parts that the tasks' files name
  palpa calibrate subtasks out/expert-a/session.palpa --learn
      for what no library knows: what was done, divided by a hidden Markov model into states that a
      task's parts can ask for
  palpa calibrate subtasks out/expert-a/session.palpa --states 3
      into three states, however many are proposed
All sessions must be of tasks whose files name their parts; with --learn or --states of one task, and
then use six trials or more, best of several experts.)";

constexpr std::int64_t kSilent_ns = 2'000'000'000, kBetween_ns = 1'000'000'000;

struct SubtaskCommand {
  std::vector<std::string> recordings;
  std::string task, out;
  std::uint64_t seed = 1;
  std::string library;
  int states = 0;
  bool learn = false, quiet = false;
};

/// Says what is being done once it has taken two seconds, then each second.
class PatientNotes {
 public:
  explicit PatientNotes(bool quiet) : quiet_(quiet) {}
  void operator()(const std::string& stage) {
    const std::int64_t now = wall_.now();
    if (quiet_ || now < next_ns_) return;
    std::fprintf(stderr, "%s\n", stage.c_str());
    next_ns_ = now + kBetween_ns;
  }

 private:
  bool quiet_;
  runtime::SteadyClock wall_;
  std::int64_t next_ns_ = kSilent_ns;
};

void learnSubtasks(const SubtaskCommand& o) {
  using namespace calibrate;
  const SubtaskRecordings recordings =
      readSubtaskRecordings({o.recordings.begin(), o.recordings.end()}, o.task);
  PatientNotes notes(o.quiet);
  const SubtaskSegmentation found = segment(
      recordings.sequences, {o.seed, o.states, [&](const std::string& stage) { notes(stage); }});
  const std::string command = "palpa calibrate subtasks" +
                              std::string(o.states ? " --states " + std::to_string(o.states) : "") +
                              " --seed " + std::to_string(o.seed);
  const Origin origin{recordings.station,   command,         "recorded sessions", runtime::utcNow(),
                      recordings.simulated, recordings.files};
  const Result result = subtaskResult(recordings, found, origin);
  session::OutputFolder output(o.out, "calibrate-subtasks");
  const std::filesystem::path& folder = output.path();
  station::writeCalibration(result.file, folder / "calibration.json");
  writeSubtaskPage(recordings, found, result, folder / "calibration.html");
  output.keep();
  std::printf("%s%s\n", result.title.c_str(), recordings.simulated ? " (SIMULATED)" : "");
  for (const std::string& sentence : result.sentences) std::printf("  %s\n", sentence.c_str());
  for (const std::string& advice : result.advice) std::printf("  Mind: %s\n", advice.c_str());
  std::printf("Written: %s\n", (folder / "calibration.html").c_str());
}

void calibrateSubtasks(const SubtaskCommand& o) {
  const bool learn = o.learn || o.states > 0;
  if (learn && !o.library.empty())
    throw UsageError("goes with neither --learn nor --states", "--library",
                     "Choose the library or a model of these recordings alone");
  if (!learn && !o.task.empty())
    throw UsageError("goes with --learn or --states", "--task",
                     "Leave it out: the library takes the parts from the recordings");
  if (learn)
    learnSubtasks(o);
  else
    proposeByLibrary(o.recordings, o.library, o.out);
}

}  // namespace

void addSubtaskCalibration(CLI::App& calibrate) {
  CLI::App* command = calibrate.add_subcommand(
      "subtasks",
      "A task's parts proposed from experts' recorded sessions, beside the hand-written ones");
  command->footer(kSubtaskExamples);
  const auto o = std::make_shared<SubtaskCommand>();
  command->add_option("RECORDING", o->recordings, "Recorded sessions (session.palpa)")
      ->required()
      ->type_name("FILE...");
  command
      ->add_option("--library", o->library,
                   "Library of interactive procedures; default: the shipped one")
      ->type_name("FILE");
  command->add_flag("--learn", o->learn,
                    "Learn states from these recordings alone, without a library");
  command
      ->add_option("--task", o->task,
                   "With --learn: task file to take the parts' names from; otherwise what was "
                   "recorded")
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  command
      ->add_option("--states", o->states, "Use this many states; otherwise as many as are proposed")
      ->check(inRange(2, calibrate::kMostProposed));
  command->add_option("--seed", o->seed, "Seed of the fits' starts")->check(atLeastZero());
  command->add_option("--out", o->out, "Folder for the results")->type_name("DIR");
  command->add_flag("--quiet", o->quiet, "No progress");
  command->callback([o] { calibrateSubtasks(*o); });
}

void addCalibrate(CLI::App& program) {
  CLI::App* calibrate = program.add_subcommand("calibrate", "Calibration routines");
  calibrate->require_subcommand(1);
  calibrate->footer(
      "Examples:\n  palpa calibrate all                         on the virtual bench\n  palpa "
      "calibrate all --station my_station.json\n  palpa calibrate camera --help");
  addStationCalibrations(*calibrate);
  addSubtaskCalibration(*calibrate);
  addProcedureCalibration(*calibrate);
  addExpertCalibration(*calibrate);
  addExpertRanges(*calibrate);
}

}  // namespace palpa::cli
