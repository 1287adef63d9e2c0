#include "apps/session/comparison_session.h"
#include "apps/runtime/clock.h"
#include "apps/training/trial_words.h"

#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

#include "anatomy/base/counted.h"
#include "anatomy/parametric/phantoms.h"
#include "apps/report/comparison/comparison_report.h"
#include "apps/session/output_folder.h"
#include "apps/session/session_facts.h"
#include "apps/station/assets.h"
#include "apps/task_comparison/comparison_scene.h"
#include "apps/twin/feeling_hands.h"
#include "apps/twin/soft_samples.h"

namespace palpa::session {
namespace {

constexpr double kOpenBeside = 0.05;  // m from the object's middle, where the tools are picked up

station::Station squeezeStation(const SessionOptions& options) {
  station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/palpation_bench.json")
                              : std::filesystem::path(options.station));
  station::judgeAge(station, runtime::utcNow());
  if (!station.sample)
    throw UsageError("has no \"sample\"", station.file.name(),
                     "Say where the object stands: sample/X_WP, the middle of its top, and "
                     "sample/tip_radius_mm");
  if (!station.force_sensor)
    throw UsageError("has no \"force_sensor\"", station.file.name(),
                     "The station must measure the force on what is held: describe the sensor");
  if (!station.second_X_WD)
    throw UsageError("has no \"second_device\"", station.file.name(),
                     "It takes two tools to hold something: say where the other device stands, "
                     "second_device/X_WD");
  return station;
}

Vec3 sizeOf(const task_comparison::ComparisonSettings& task) { return Vec3::Constant(2 * task.half); }

}  // namespace

SqueezeWorld::SqueezeWorld(const SessionOptions& options)
    : station(squeezeStation(options)),
      task(task_comparison::readSqueeze(options.task.empty() ? station::assetFile("tasks/squeeze.json")
                                                          : std::filesystem::path(options.task))),
      object(anatomy::phantomBlock(sizeOf(task), task.title)),
      X_WO(station.sample->X_WP * makePose(Mat3::Identity(), Vec3(0, 0, -task.half))),
      X_WA(station.sample->X_WP * anatomy::X_AP().inverse()) {
  task.library = station::onStation(std::move(task.library), station.calibrations);
  if (std::abs(station.sample->tip_radius - task.library.tip_radius) > 1e-6)
    station.file.refuse("sample/tip_radius_mm",
                        "is not that of the tip with which the object's sides were identified");
}

haptics::PairConfig SqueezeWorld::pairConfig(const SessionOptions& options) const {
  haptics::PairConfig pair;
  const Pose X_WP = station.sample->X_WP;
  for (std::size_t t = 0; t < 2; ++t) {
    haptics::TickConfig& tick = pair.tools[t];
    tick.contact_mode = haptics::ContactMode::sensed_object;
    tick.object_at_port = 1;
    tick.coupling = station.coupling;
    tick.safety = station.safety;
    tick.safety.deadman_button = 0;  // two simulated fingers: nobody could hold it
    tick.passivity = station.passivity;
    tick.X_ET = pack(station.X_ET);
    tick.touch = station::touchOf(task.library);
    tick.X_DP = pack(Pose((t == 0 ? station.X_WD : *station.second_X_WD).inverse() * X_WP));
    tick.period_ns = std::llround(1e9 / options.rate_Hz);
  }
  pair.squeezing = 1;
  pair.squeeze.real = task.library.surface;
  pair.squeeze.x0 = task.library.x0;
  pair.squeeze.least_contact = task.touch;
  return pair;
}

SessionDevices::Hands SqueezeWorld::hands(const SessionOptions& options) const {
  const twin::SqueezingSkill skill = twin::readSqueezingSkill(operatorFile(options, "squeeze_"));
  auto fingers =
      twin::squeezingHands(skill, {X_WA.inverse() * X_WO, task.half}, station.X_ET, options.seed);
  const auto pickedUp = [&](const Pose& X_WD, double side) {
    const Pose X_WT =
        X_WO * makePose(rotationWithZ(Vec3(-side, 0, 0)), Vec3(side * kOpenBeside, 0, 0));
    return Pose(X_WD.inverse() * X_WT * station.X_ET.inverse());
  };
  twin::VirtualBenchSetup bench{.station = station,
                                .hand = std::move(fingers[0]),
                                .X_DE_start = pickedUp(station.X_WD, 1),
                                .watched_W = X_WO.translation(),
                                .normal_W = X_WO.linear() * Vec3::UnitZ(),
                                .seed = options.benchSeed()};
  bench.second = twin::SecondTool{.hand = std::move(fingers[1]),
                                  .X_WD = *station.second_X_WD,
                                  .X_DE_start = pickedUp(*station.second_X_WD, -1)};
  if (isSimulated(options.who)) {
    const auto held = std::make_shared<twin::HeldObjectTwin>(
        station, twin::HeldObject::Shape{task.half, task.mass}, X_WO, options.benchSeed());
    bench.real_thing = [held](const std::array<Pose, 2>& X_WT_true, double dt) {
      const std::array<twin::SampleTouch, 2> touches = held->step(X_WT_true, dt);
      return std::array<twin::RealTouch, 2>{
          {{touches[0].f_W, touches[0].p_W}, {touches[1].f_W, touches[1].p_W}}};
    };
  }
  return {std::move(bench), std::nullopt, task.library.tip_radius};
}

record::SessionInfo SqueezeWorld::info(const SessionOptions& options) const {
  record::SessionInfo info = infoOf(options, head(options));
  info.station_json = station.file.json().dump();
  info.task_json = task.source;
  info.pair_config = pairConfig(options);
  info.tick_config = info.pair_config->tools[0];
  return info;
}

ComparisonRun runComparison(const SessionOptions& options, const SqueezeWorld& world,
                      const std::filesystem::path& folder) {
  task_comparison::ComparisonChannels channels(options.fast ? runtime::TimeMode::virtual_time
                                                      : runtime::TimeMode::real);
  const haptics::PairConfig pair = world.pairConfig(options);
  SessionFrame frame(options, {world.station, world.object, world.X_WA, pair.tools[0], pair, false},
                     world.hands(options), channels, folder);
  const std::string not_scored = world.station.calibrationProblem();
  task_comparison::ComparisonTask task(
      {.settings = world.task,
       .simulated = true,
       .automatic = true,
       .force_feedback = options.force_feedback,
       .not_scored = not_scored,
       .seed = options.seed,
       .comparisons = task_comparison::comparisonsOf(world.task, options.seed, options.trials),
       .places = frame.places(),
       .role = options.role},
      frame.bus(), channels, frame.executive());
  task_comparison::ComparisonScene scene({.stage = frame.stage(),
                                    .X_WD2 = *world.station.second_X_WD,
                                    .middle_A = (world.X_WA.inverse() * world.X_WO).translation()},
                                   frame.bus(), channels);
  ComparisonRun run;
  static_cast<SessionRun&>(run) = frame.run(task, scene, world.info(options));
  run.trials = task.completed();
  return run;
}

ReportHead SqueezeWorld::head(const SessionOptions& options) const {
  ReportHead head = headOf(options, task.title, task.taxonomy, true);
  head.too_hard_N = task.too_hard;
  head.station = stationFactsOf(options, station);
  head.station.push_back(surfaceFact(task.library));
  return head;
}

void writeComparisonResults(const ReportHead& head,
                         const std::vector<task_comparison::CompletedComparison>& trials,
                         const ReportTail& tail, const std::filesystem::path& evidence) {
  report::ComparisonReport page;
  std::vector<assess::ComparisonTrial> scored;
  for (const task_comparison::CompletedComparison& trial : trials) {
    page.trials.push_back(trial.trial);
    if (training::countsAsScored(trial.trial.role) &&
        trial.trial.outcome != training::Outcome::voided)
      scored.push_back(trial.trial);
  }
  const std::filesystem::path folder = evidence.parent_path();
  report::writeComparisonCsv(head.user_id, scored, folder / "trials.csv");
  if (!head.page) return;
  page.title = head.title;
  page.trainee = head.trainee;
  page.simulated = head.simulated;
  page.too_hard_N = head.too_hard_N;
  for (const trial::SavedPicture& p : tail.pictures)
    page.pictures.push_back({p.file, p.moment.caption, p.moment.t_s});
  page.taxonomy = head.taxonomy;
  page.station = head.station;
  page.notes = tail.notes;
  report::writeComparisonReport(page, folder / "report.html");
}

void writeComparisonOutcome(const SessionOptions& options, const SqueezeWorld& world,
                         const ComparisonRun& run, const std::filesystem::path& folder) {
  writeComparisonResults(world.head(options), run.trials, {run.pictures, runNotes(run)},
                      folder / "session.palpa");

  for (const task_comparison::CompletedComparison& trial : run.trials)
    std::printf("Trial %d (%s, simulated): %s\n", trial.trial.trial,
                training::nameOf(trial.trial.role).c_str(),
                trial.reason.empty() ? summaryOf(trial.trial).c_str() : trial.reason.c_str());
  if (!options.report) return;
  std::printf("Written to %s:\n", folder.string().c_str());
  std::printf("  report.html     what was told apart, and how well: open this first\n");
  std::printf(
      "  trials.csv      one row a scored trial\n  session.palpa   the evidence: every tick of "
      "both tools, for replay\n");
  if (!run.pictures.empty())
    std::printf("  view-*.png      %s of the marked moments\n",
                counted(run.pictures.size(), "picture").c_str());
}

}  // namespace palpa::session
