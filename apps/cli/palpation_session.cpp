#include "apps/cli/palpation_session.h"

#include "apps/task_palpation/palpation_scene.h"

namespace palpa::cli {
namespace {

/// Empty: trials count.
std::string whyUnscored(const SessionOptions& options, const PalpationWorld& world) {
  if (world.station.calibration_verdict != "pass") return world.station.calibration_verdict;
  if (options.see_through) return "the lumps were shown";
  if (options.who == OperatorKind::person && world.onBench())
    return "led with a mouse: nothing was felt";
  return "";
}

std::vector<task_palpation::PalpationPlan> planOf(const SessionOptions& options,
                                                  const PalpationWorld& world) {
  const bool scored = whyUnscored(options, world).empty();
  std::vector<task_palpation::PalpationPlan> plan;
  for (int i = 0; i < options.trials; ++i) {
    plan.push_back({scored ? options.role : "not scored",
                    options.seed + static_cast<std::uint64_t>(i), options.force_feedback,
                    options.augment});
  }
  return plan;
}

}  // namespace

PalpationRun runPalpation(const SessionOptions& options, const PalpationWorld& world,
                          const std::filesystem::path& folder) {
  task_palpation::PalpationChannels channels(options.fast ? runtime::TimeMode::virtual_time
                                                          : runtime::TimeMode::real);
  const haptics::TickConfig tick = world.tickConfig(options);
  SessionFrame frame(options, {world.station, world.phantom, world.X_WA, tick},
                     world.hands(options), channels, folder);
  task_palpation::PalpationTask task(
      {world.task, tick, world.simulated(options), options.who != OperatorKind::person,
       options.see_through, options.guidance, whyUnscored(options, world), planOf(options, world),
       frame.places()},
      frame.bus(), channels, frame.executive());
  task_palpation::PalpationScene scene(
      {frame.stage(), anatomy::X_AP(), world.task.scoring.rules.area, world.task.library.tip_radius,
       world.forceNote()},
      frame.bus(), channels);
  PalpationRun run;
  static_cast<SessionRun&>(run) = frame.run(task, scene, world.info(options));
  run.trials = task.completed();
  return run;
}

}  // namespace palpa::cli
