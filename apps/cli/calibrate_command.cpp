#include <cstdio>
#include <memory>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/units.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/calibrate/subtask_page.h"
#include "apps/cli/commands.h"
#include "apps/evidence/recorded_session.h"
#include "apps/runtime/clock.h"
#include "apps/session/needle_session.h"
#include "apps/session/output_folder.h"
#include "apps/training/trial_words.h"

namespace palpa::cli {
namespace {

constexpr const char* kSubtaskExamples = R"(Examples:
  palpa calibrate subtasks out/expert-a/session.palpa out/expert-b/session.palpa --out parts
      what experts did, divided by a hidden Markov model, beside the parts that the task's file names
  palpa calibrate subtasks out/expert-a/session.palpa --states 3
      into three states, however many are proposed
All sessions must be of one task whose file names its parts. Use six trials or more, best of several experts.)";

constexpr std::int64_t kSilent_ns = 2'000'000'000, kBetween_ns = 1'000'000'000;

struct SubtaskCommand {
  std::vector<std::string> recordings;
  std::string task, out;
  std::uint64_t seed = 1;
  int states = 0;
  bool quiet = false;
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

void calibrateSubtasks(const SubtaskCommand& o) {
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
  const std::filesystem::path folder = session::makeOutputFolder(o.out, "calibrate-subtasks");
  station::writeCalibration(result.file, folder / "calibration.json");
  writeSubtaskPage(recordings, found, result, folder / "calibration.html");
  std::printf("%s%s\n", result.title.c_str(), recordings.simulated ? " (SIMULATED)" : "");
  for (const std::string& sentence : result.sentences) std::printf("  %s\n", sentence.c_str());
  for (const std::string& advice : result.advice) std::printf("  Mind: %s\n", advice.c_str());
  std::printf("Written: %s\n", (folder / "calibration.html").c_str());
}

}  // namespace

void addSubtaskCalibration(CLI::App& calibrate) {
  CLI::App* command = calibrate.add_subcommand(
      "subtasks",
      "A task's parts proposed from experts' recorded sessions, beside the hand-written ones");
  command->footer(kSubtaskExamples);
  const auto o = std::make_shared<SubtaskCommand>();
  command->add_option("RECORDING", o->recordings, "Recorded sessions (session.palpa) of one task")
      ->required()
      ->type_name("FILE...");
  command
      ->add_option("--task", o->task,
                   "Task file to take the parts' names from; otherwise what was recorded")
      ->type_name("FILE");
  command
      ->add_option("--states", o->states, "Use this many states; otherwise as many as are proposed")
      ->check(CLI::Range(2, calibrate::kMostProposed));
  command->add_option("--seed", o->seed, "Seed of the fits' starts")->check(CLI::NonNegativeNumber);
  command->add_option("--out", o->out, "Folder for the results")->type_name("DIR");
  command->add_flag("--quiet", o->quiet, "No progress");
  command->callback([o] { calibrateSubtasks(*o); });
}

namespace {

constexpr const char* kExpertExamples = R"(Examples:
  palpa calibrate experts --from out/expert-a/session.palpa out/expert-b/session.palpa --out path.json
      the expert path from experts' recorded trials
  palpa calibrate experts --simulate 50 --experts 3 --seed 900001 --out assets/tasks/paracentesis_expert_path.json
      the shipped path, made again: three simulated experts, fifty trials each
Experts who calibrate must not take part in a study that uses the path.)";

struct ExpertOptions {
  std::vector<std::string> from;
  int simulate = 0, experts = 3, least = 20;
  std::uint64_t seed = 900001;
  std::string out = "expert_path.json", sessions;
};

/// Records trials of simulated experts; returns the session files.
std::vector<std::string> simulateExperts(const ExpertOptions& o) {
  const std::filesystem::path folder = session::makeOutputFolder(o.sessions, "calibrate-experts");
  std::vector<std::string> files;
  for (int expert = 0; expert < o.experts; ++expert) {
    session::SessionOptions session;
    session.command = "calibrate experts";
    session.who = session::OperatorKind::expert;
    session.seed = o.seed + 1000 * static_cast<std::uint64_t>(expert);
    session.trials = o.simulate;
    session.trainee = "simulated-expert-" + std::to_string(expert + 1);
    session.fast = session.no_views = session.record_only = true;
    session.display = scene::Display::offscreen;
    session::NeedleWorld world(session);
    world.station.camera_rate_Hz = 2;  // pictures serve the ready check only: fewer save time
    const std::filesystem::path place =
        session::makeOutputFolder((folder / session.trainee).string(), "");
    std::fprintf(stderr, "%s: %s\n", session.trainee.c_str(), counted(o.simulate, "trial").c_str());
    if (session::runNeedleSession(session, world, place).quit)
      throw Error("was interrupted", "palpa calibrate experts", "Start it again");
    files.push_back((place / "session.palpa").string());
  }
  return files;
}

/// Who takes part in no study that uses the path: the pseudonym; of simulated experts without one
/// the folder of their session.
std::string expertOf(const evidence::RecordedSession& session, const std::string& file) {
  static const std::string kNobody = session::SessionOptions().trainee;
  if (session.trainee() != kNobody && !session.trainee().empty()) return session.trainee();
  return session.simulated() ? std::filesystem::path(file).parent_path().filename().string()
                             : session.operatorName();
}

void calibrateExperts(ExpertOptions o) {
  if (o.from.empty() == (o.simulate == 0))
    throw UsageError("needs either --from or --simulate", "palpa calibrate experts",
                     "See its --help");
  if (o.simulate) o.from = simulateExperts(o);
  std::vector<calibration::ExpertTrial> trials;
  bool simulated = false;
  std::size_t seen = 0;
  for (const std::string& file : o.from) {
    const evidence::RecordedSession session(file);
    const anatomy::LandmarkFrame frame(session.patient());
    const calibration::TeachingLine line =
        assess::teachingLineOf(session.patient(), session.query());
    simulated = simulated || session.simulated();
    session.eachTrial(
        [&](const record::RecordedTrial& trial, const evidence::RecordedSession::Samples& samples) {
          ++seen;
          calibration::ExpertTrial expert;
          if (training::outcomeNamed(trial.end.outcome) == training::Outcome::success &&
              assess::expertTrial(samples, frame, line, expertOf(session, file), &expert)) {
            trials.push_back(std::move(expert));
          }
        });
  }
  calibration::ExpertPath path = calibration::fitExpertPath(trials, o.least);
  path.simulated = simulated;
  path.made_by = o.simulate ? "palpa calibrate experts --simulate " + std::to_string(o.simulate) +
                                  " --experts " + std::to_string(o.experts) + " --seed " +
                                  std::to_string(o.seed)
                            : "palpa calibrate experts --from ...";
  calibration::writeExpertPath(path, o.out);
  std::printf("%zu of %zu trials were complete; %d agree and make the path%s\n", trials.size(),
              seen, path.trials, simulated ? " (simulated experts)" : "");
  std::printf(
      "Depth of phase 1: %.1f mm. Deviation that is acceptable (2 standard deviations): entry %.1f "
      "mm, depth %.1f mm, direction %.1f degrees, line %.1f mm\n",
      1e3 * path.depth, 1e3 * path.entry_acceptable, 1e3 * path.depth_acceptable,
      path.direction_acceptable / kDegree, 1e3 * path.line_acceptable);
  std::printf("Written: %s\n", o.out.c_str());
}

}  // namespace

void addCalibrate(CLI::App& program) {
  CLI::App* calibrate = program.add_subcommand("calibrate", "Calibration routines");
  calibrate->require_subcommand(1);
  addStationCalibrations(*calibrate);
  addSubtaskCalibration(*calibrate);
  CLI::App* experts =
      calibrate->add_subcommand("experts", "The expert path from experts' recorded trials");
  experts->footer(kExpertExamples);
  const auto o = std::make_shared<ExpertOptions>();
  experts->add_option("--from", o->from, "Recorded sessions of experts")->type_name("FILE...");
  experts
      ->add_option("--simulate", o->simulate,
                   "Record this many trials of each simulated expert first")
      ->check(CLI::Range(1, 1000));
  experts->add_option("--experts", o->experts, "How many simulated experts")
      ->check(CLI::Range(1, 20));
  experts->add_option("--seed", o->seed, "Seed of the simulated experts")
      ->check(CLI::NonNegativeNumber);
  experts->add_option("--least", o->least, "Fewest trials to accept")->check(CLI::Range(3, 1000));
  experts->add_option("--sessions", o->sessions, "Folder for the simulated sessions")
      ->type_name("DIR");
  experts->add_option("--out", o->out, "File to write")->type_name("FILE");
  experts->callback([o] { calibrateExperts(*o); });
}

}  // namespace palpa::cli
