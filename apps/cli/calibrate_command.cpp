#include <cstdio>
#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/cli/calibrate_station.h"
#include "apps/cli/calibrate_subtasks.h"
#include "apps/cli/commands.h"
#include "apps/cli/needle_session.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/recorded_session.h"

namespace palpa::cli {
namespace {

constexpr const char* kExpertExamples = R"(Examples:
  palpa calibrate experts --from out/expert-a/session.palpa out/expert-b/session.palpa --out path.json
      the optimal path from experts' recorded trials
  palpa calibrate experts --simulate 50 --experts 3 --seed 900001 --out assets/tasks/paracentesis_expert_path.json
      the shipped path, remade: three simulated experts, fifty trials each
Experts who calibrate take no part in a study that uses the path.)";

struct ExpertOptions {
  std::vector<std::string> from;
  int simulate = 0, experts = 3, least = 20;
  std::uint64_t seed = 900001;
  std::string out = "expert_path.json", sessions;
};

/// Records trials of simulated experts; returns the session files.
std::vector<std::string> simulateExperts(const ExpertOptions& o) {
  const std::filesystem::path folder = makeOutputFolder(o.sessions, "calibrate-experts");
  std::vector<std::string> files;
  for (int expert = 0; expert < o.experts; ++expert) {
    SessionOptions session;
    session.command = "calibrate experts";
    session.who = OperatorKind::expert;
    session.seed = o.seed + 1000 * static_cast<std::uint64_t>(expert);
    session.trials = o.simulate;
    session.trainee = "simulated-expert-" + std::to_string(expert + 1);
    session.fast = session.no_views = session.record_only = true;
    session.display = scene::Display::offscreen;
    NeedleWorld world(session);
    world.station.camera_rate_Hz = 2;  // pictures serve the ready check only: fewer save time
    const std::filesystem::path place = makeOutputFolder((folder / session.trainee).string(), "");
    std::fprintf(stderr, "%s: %d trials\n", session.trainee.c_str(), o.simulate);
    if (runNeedleSession(session, world, place).quit)
      throw Error("was interrupted", "palpa calibrate experts", "Start it again");
    files.push_back((place / "session.palpa").string());
  }
  return files;
}

/// Who takes part in no study that uses the path: the pseudonym; of simulated experts without one
/// the folder of their session.
std::string expertOf(const RecordedSession& session, const std::string& file) {
  static const std::string kNobody = SessionOptions().trainee;
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
    const RecordedSession session(file);
    const anatomy::LandmarkFrame frame(session.patient());
    simulated = simulated || session.simulated();
    session.eachTrial(
        [&](const record::RecordedTrial& trial, const RecordedSession::Samples& samples) {
          ++seen;
          calibration::ExpertTrial expert;
          if (trial.end.outcome == "success" &&
              assess::expertTrial(samples, frame, expertOf(session, file), &expert)) {
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
  constexpr double kDeg = 57.29577951308232;
  std::printf("%zu of %zu trials were complete; %d agree and make the path%s\n", trials.size(),
              seen, path.trials, simulated ? " (simulated experts)" : "");
  std::printf(
      "Entry +- %.1f mm, depth of phase 1 %.1f +- %.1f mm, direction +- %.1f degrees (acceptable "
      "%.1f)\n",
      1e3 * path.entry_sd, 1e3 * path.depth, 1e3 * path.depth_sd, kDeg * path.direction_sd,
      kDeg * path.direction_acceptable);
  std::printf("Written: %s\n", o.out.c_str());
}

}  // namespace

void addCalibrate(CLI::App& program) {
  CLI::App* calibrate = program.add_subcommand("calibrate", "Calibration routines");
  calibrate->require_subcommand(1);
  addStationCalibrations(*calibrate);
  addSubtaskCalibration(*calibrate);
  CLI::App* experts =
      calibrate->add_subcommand("experts", "The optimal path from experts' recorded trials");
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
