#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/units.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/evidence/recorded_session.h"
#include "apps/session/needle_session.h"
#include "apps/session/output_folder.h"
#include "apps/training/trial_words.h"

namespace palpa::cli {
namespace {

constexpr const char* kExpertExamples = R"(Examples:
  palpa calibrate experts --from out/expert-a/session.palpa out/expert-b/session.palpa --out path.json
      the expert path from experts' recorded trials
  palpa calibrate experts --simulate 1 --patients 50 --seed 900001 --out assets/tasks/paracentesis_expert_path.json
      the shipped path, made again: three simulated experts, once each on fifty drawn patients
Experts who puncture several patients teach more than one body's path. Let them study its pictures first.
Experts who calibrate must not take part in a study that uses the path.)";

struct ExpertOptions {
  std::vector<std::string> from;
  int simulate = 0, experts = 3, patients = 0, least = 20;
  std::uint64_t seed = 900001;
  std::string out = "expert_path.json", sessions;
};

session::SessionOptions optionsOf(const ExpertOptions& o, int body) {
  session::SessionOptions session;
  session.command = "calibrate experts";
  session.who = session::OperatorKind::expert;
  session.trials = o.simulate;
  session.fast = session.no_views = session.record_only = session.quiet = true;
  session.display = scene::Display::offscreen;
  if (o.patients == 0) return session;
  session.patient_seed = o.seed + static_cast<std::uint64_t>(body);
  session.side = body % 2 ? anatomy::Side::left : anatomy::Side::right;
  session.knows_patient = true;
  return session;
}

/// Trials of all simulated experts on one body; adds the session files. None where the body cannot
/// be scored.
void simulateOn(const ExpertOptions& o, int body, const std::filesystem::path& folder,
                std::vector<std::string>* files) {
  session::SessionOptions session = optionsOf(o, body);
  session::NeedleWorld world(session);
  world.station.camera_rate_Hz = 2;  // pictures serve the ready check only: fewer save time
  const std::string where = o.patients ? "patient " + std::to_string(session.patient_seed)
                                       : std::string("the reference patient");
  if (!world.not_scored.empty()) {
    std::fprintf(stderr, "%s: left out. %s\n", where.c_str(), world.not_scored.c_str());
    return;
  }
  for (int expert = 0; expert < o.experts; ++expert) {
    session.seed =
        o.seed + 1000 * static_cast<std::uint64_t>(expert) + static_cast<std::uint64_t>(body);
    session.trainee = "simulated-expert-" + std::to_string(expert + 1);
    const std::string name =
        session.trainee + (o.patients ? "-on-" + std::to_string(session.patient_seed) : "");
    const std::filesystem::path place = session::makeOutputFolder((folder / name).string(), "");
    std::fprintf(stderr, "%s on %s: %s\n", session.trainee.c_str(), where.c_str(),
                 counted(o.simulate, "trial").c_str());
    if (session::runNeedleSession(session, world, place).quit)
      throw Error("was interrupted", "palpa calibrate experts", "Start it again");
    files->push_back((place / "session.palpa").string());
  }
}

/// Records trials of simulated experts; returns the session files.
std::vector<std::string> simulateExperts(const ExpertOptions& o) {
  const std::filesystem::path folder = session::makeOutputFolder(o.sessions, "calibrate-experts");
  std::vector<std::string> files;
  for (int body = 0; body < std::max(o.patients, 1); ++body) simulateOn(o, body, folder, &files);
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

std::string madeBy(const ExpertOptions& o) {
  if (!o.simulate) return "palpa calibrate experts --from ...";
  return "palpa calibrate experts --simulate " + std::to_string(o.simulate) + " --experts " +
         std::to_string(o.experts) +
         (o.patients ? " --patients " + std::to_string(o.patients) : "") + " --seed " +
         std::to_string(o.seed);
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
  path.made_by = madeBy(o);
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

void addExpertCalibration(CLI::App& calibrate) {
  CLI::App* experts =
      calibrate.add_subcommand("experts", "The expert path from experts' recorded trials");
  experts->footer(kExpertExamples);
  const auto o = std::make_shared<ExpertOptions>();
  experts->add_option("--from", o->from, "Recorded sessions of experts")->type_name("FILE...");
  experts
      ->add_option("--simulate", o->simulate,
                   "Record this many trials of each simulated expert first, on each patient")
      ->check(inRange(1, 1000));
  experts->add_option("--experts", o->experts, "How many simulated experts")->check(inRange(1, 20));
  experts
      ->add_option("--patients", o->patients,
                   "On so many drawn patients, whose pictures the simulated experts have studied; "
                   "default: on the reference patient, by the mean anatomy")
      ->check(inRange(1, 1000));
  experts->add_option("--seed", o->seed, "Seed of the simulated experts")->check(atLeastZero());
  experts->add_option("--least", o->least, "Fewest trials to accept")->check(inRange(3, 1000));
  experts->add_option("--sessions", o->sessions, "Folder for the simulated sessions")
      ->type_name("DIR");
  experts->add_option("--out", o->out, "File to write")->type_name("FILE");
  experts->callback([o] { calibrateExperts(*o); });
}

}  // namespace palpa::cli
