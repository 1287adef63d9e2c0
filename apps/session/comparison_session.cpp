#include "apps/session/comparison_session.h"
#include "apps/runtime/clock.h"
#include "apps/training/trial_words.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

#include "anatomy/parametric/phantoms.h"
#include "apps/report/comparison/comparison_report.h"
#include "apps/session/output_folder.h"
#include "apps/session/session_facts.h"
#include "apps/station/assets.h"
#include "apps/task_comparison/comparison_scene.h"
#include "apps/twin/feeling_hands.h"
#include "apps/twin/soft_samples.h"

namespace palpa::session {

using training::Engine;

namespace {

constexpr double kOpenBeside = 0.05;  // m from the object's middle, where the tools are picked up

station::Station comparisonStation(const SessionOptions& options, Engine engine) {
  const bool held = engine == Engine::squeeze;
  station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/palpation_bench.json")
                              : std::filesystem::path(options.station));
  station::judgeAge(station, runtime::utcNow());
  if (!station.sample)
    throw UsageError("has no \"sample\"", station.file.name(),
                     std::string("Say where the ") + (held ? "object stands" : "silicone lies") +
                         ": sample/X_WP, the middle of its top, and sample/tip_radius_mm");
  if (!station.force_sensor)
    throw UsageError("has no \"force_sensor\"", station.file.name(),
                     std::string("The station must measure the force on what is ") +
                         (held ? "held" : "stroked") + ": describe the sensor");
  if (held && !station.second_X_WD)
    throw UsageError("has no \"second_device\"", station.file.name(),
                     "It takes two tools to hold something: say where the other device stands, "
                     "second_device/X_WD");
  if (!held && station.device.driver == station::DeviceDriver::bench &&
      station.force_sensor->driver != station::ForceSensorDriver::bench)
    station.file.refuse("force_sensor/driver",
                        "is a real sensor, but the device is simulated and touches simulated "
                        "silicone; it must be \"virtual\", too");
  return station;
}

task_comparison::ComparisonSettings taskOf(const SessionOptions& options, Engine engine) {
  const bool held = engine == Engine::squeeze;
  const std::filesystem::path file =
      options.task.empty() ? station::assetFile(held ? "tasks/squeeze.json" : "tasks/friction.json")
                           : std::filesystem::path(options.task);
  return held ? task_comparison::readSqueeze(file) : task_comparison::readFriction(file);
}

anatomy::Patient shownObject(const task_comparison::ComparisonSettings& task, Engine engine) {
  const Vec3 size = engine == Engine::squeeze ? Vec3(Vec3::Constant(2 * task.half)) : task.size;
  return anatomy::phantomBlock(size, task.title);
}

twin::RealTouch feltOf(const twin::SampleTouch& touch) { return {touch.f_W, touch.p_W}; }

}  // namespace

ComparisonWorld::ComparisonWorld(const SessionOptions& options, Engine of)
    : engine(of),
      station(comparisonStation(options, of)),
      task(taskOf(options, of)),
      object(shownObject(task, of)),
      X_WO(station.sample->X_WP *
           makePose(Mat3::Identity(), Vec3(0, 0, tools() == 2 ? -task.half : 0))),
      X_WA(station.sample->X_WP * anatomy::X_AP().inverse()) {
  task.library = libraryOn(options, station, std::move(task.library));
  if (std::abs(station.sample->tip_radius - task.library.tip_radius) > 1e-6)
    station.file.refuse("sample/tip_radius_mm",
                        tools() == 2
                            ? "is not that of the tip with which the object's sides were identified"
                            : "is not that of the tip with which the silicone was identified");
}

haptics::TickConfig ComparisonWorld::tickConfig(const SessionOptions& options) const {
  haptics::TickConfig tick = sensedTick(options, station, task.library);
  tick.touch.other_friction = engine == Engine::friction;
  if (tools() == 2) tick.device_turns = 1;  // two simulated devices
  return tick;
}

std::optional<haptics::PairConfig> ComparisonWorld::pairConfig(
    const SessionOptions& options) const {
  if (tools() == 1) return std::nullopt;
  haptics::PairConfig pair;
  pair.tools = {tickConfig(options), tickConfig(options)};
  pair.tools[1].X_DP = pack(Pose(station.second_X_WD->inverse() * station.sample->X_WP));
  for (haptics::TickConfig& tool : pair.tools)
    tool.safety.deadman_button = 0;  // two simulated fingers: nobody could hold it
  pair.squeezing = 1;
  pair.squeeze.real = task.library.surface;
  pair.squeeze.x0 = task.library.x0;
  pair.squeeze.least_contact = task.touch;
  return pair;
}

SessionDevices::Hands ComparisonWorld::hands(const SessionOptions& options) const {
  return tools() == 2 ? holding(options) : stroking(options);
}

SessionDevices::Hands ComparisonWorld::holding(const SessionOptions& options) const {
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
      return std::array<twin::RealTouch, 2>{feltOf(touches[0]), feltOf(touches[1])};
    };
  }
  return {std::move(bench), std::nullopt, task.library.tip_radius};
}

SessionDevices::Hands ComparisonWorld::stroking(const SessionOptions& options) const {
  const twin::StrokingSkill skill = twin::readStrokingSkill(operatorFile(options, "friction_"));
  return SessionDevices::overSilicone(
      options, station, twin::strokingHand(skill, anatomy::X_AP(), station.X_ET, options.seed),
      X_WO, task.library.tip_radius);
}

record::SessionInfo ComparisonWorld::info(const SessionOptions& options) const {
  record::SessionInfo info =
      tools() == 2 ? infoOf(options, head(options), task.source)
                   : infoOf(options, head(options), task.source, {{"sort", options.sort}});
  info.station_json = station.file.json().dump();
  info.pair_config = pairConfig(options);
  info.tick_config = info.pair_config ? info.pair_config->tools[0] : tickConfig(options);
  return info;
}

ComparisonRun runComparison(const SessionOptions& options, const ComparisonWorld& world,
                            const std::filesystem::path& folder) {
  task_comparison::ComparisonChannels channels(options.fast ? runtime::TimeMode::virtual_time
                                                            : runtime::TimeMode::real);
  const haptics::TickConfig tick = world.tickConfig(options);
  SessionFrame frame(options,
                     {world.engine, world.station, world.object, world.X_WA, tick,
                      world.pairConfig(options), false},
                     world.hands(options), channels, folder);
  const std::string not_scored = world.station.calibrationProblem();
  task_comparison::ComparisonTask task(
      {.settings = world.task,
       .tools = world.tools(),
       .simulated = world.simulated(options),
       .automatic = options.who != OperatorKind::person,
       .force_feedback = options.force_feedback,
       .not_scored = not_scored,
       .seed = options.seed,
       .comparisons =
           options.sort ? task_comparison::sortingsOf(world.task, options.seed, options.trials)
                        : task_comparison::comparisonsOf(world.task, options.seed, options.trials),
       .places = frame.places(),
       .role = options.role},
      frame.bus(), channels, frame.executive());
  const Pose X_AO = world.X_WA.inverse() * world.X_WO;
  task_comparison::ComparisonScene scene(
      {.stage = frame.stage(),
       .X_WD2 = world.tools() == 2 ? world.station.second_X_WD : std::nullopt,
       .middle_A = X_AO.translation(),
       .up_A = X_AO.linear() * Vec3::UnitZ()},
      frame.bus(), channels);
  ComparisonRun run;
  task.isFor(world.task.brief);
  static_cast<SessionRun&>(run) = frame.run(task, scene, world.info(options));
  run.trials = task.completed();
  return run;
}

ReportHead ComparisonWorld::head(const SessionOptions& options) const {
  ReportHead head = headOf(options, task.title, task.taxonomy, station, simulated(options));
  head.too_hard_N = task.too_hard;
  head.station.push_back(surfaceFact(task.library));
  return head;
}

void writeComparisonResults(const ReportHead& head,
                            const std::vector<task_comparison::CompletedComparison>& trials,
                            const ReportTail& tail, const std::filesystem::path& evidence) {
  report::ComparisonReport page;
  for (const task_comparison::CompletedComparison& trial : trials)
    page.trials.push_back(trial.trial);
  const std::filesystem::path folder = evidence.parent_path();
  report::writeComparisonCsv(head.user_id, page.trials, folder / "trials.csv");
  if (!head.page) return;
  const bool rubbed =
      !page.trials.empty() && page.trials[0].property == assess::ComparedProperty::friction;
  static_cast<report::SessionPage&>(page) =
      pageOf(head, tail, evidence, rubbed ? Engine::friction : Engine::squeeze,
             judgedOf(trials, [&](const auto& t) {
               return progress::JudgedTrial{t.trial.role, t.trial.outcome,
                                            assess::comparisonMetrics(t.trial)};
             }));
  page.too_hard_N = head.too_hard_N;
  page.pictures = picturesOf(tail);
  report::writeComparisonReport(page, folder / "report.html");
}

void writeComparisonOutcome(const SessionOptions& options, const ComparisonWorld& world,
                            const ComparisonRun& run, const std::filesystem::path& folder) {
  writeComparisonResults(world.head(options), run.trials, {run.pictures, runNotes(run)},
                         folder / "session.palpa");

  for (const task_comparison::CompletedComparison& trial : run.trials)
    std::printf("Trial %d (%s%s): %s\n", trial.trial.trial,
                training::nameOf(trial.trial.role).c_str(),
                trial.trial.simulated ? ", simulated" : "",
                trial.reason.empty() ? summaryOf(trial.trial).c_str() : trial.reason.c_str());
  if (options.report) sayWritten(run, folder, "what was told apart, and how well", "scored trial");
}

}  // namespace palpa::session
