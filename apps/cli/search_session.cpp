#include "apps/cli/search_session.h"

#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"
#include "anatomy/phantom_block.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/session_arguments.h"
#include "apps/cli/session_info.h"
#include "apps/station/assets.h"
#include "apps/task_search/search_scene.h"
#include "apps/twin/learning_hand.h"

namespace palpa::cli {
namespace {

using assess::SearchMode;

constexpr double kPlateThick = 0.02;  // m, as shown
constexpr SearchMode kModes[] = {SearchMode::real, SearchMode::degraded, SearchMode::augmented};

station::Station searchStation(const SessionOptions& options) {
  station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/search_bench.json")
                              : std::filesystem::path(options.station));
  station::judgeAge(station, utcNow());
  return station;
}

/// "all": the same episodes in every mode, one mode after the other for each.
std::vector<task_search::Episode> episodesFor(const SessionOptions& options,
                                              const task_search::SearchSettings& task) {
  if (options.mode != "all") {
    const SearchMode mode = *assess::searchModeOf(options.mode);
    return options.blocks ? task_search::blocksOf(task, options.seed, mode)
                          : task_search::episodesOf(options.seed, options.trials, mode);
  }
  if (options.blocks)
    throw UsageError("go with one mode", "--blocks, --mode all",
                     "Say in which mode training goes: --mode degraded or augmented");
  std::vector<task_search::Episode> all;
  for (task_search::Episode episode :
       task_search::episodesOf(options.seed, options.trials, SearchMode::real))
    for (const SearchMode mode : kModes) {
      episode.mode = mode;
      all.push_back(episode);
    }
  return all;
}

Vec3 plateSize(const task_search::SearchSettings& task) {
  const double side = task.spec.side * task.shown_per_U;
  return {side, side, kPlateThick};
}

std::unique_ptr<twin::Hand> searchingHandOf(const SessionOptions& options,
                                            const twin::VisibleFloor& seen, const Pose& X_ET) {
  if (options.who != OperatorKind::learner)
    return twin::searchingHand(
        twin::readSearchingSkill(station::assetFile(options.who == OperatorKind::novice
                                                        ? "operators/search_novice.json"
                                                        : "operators/search_expert.json")),
        seen, X_ET, options.seed);
  return std::make_unique<twin::LearningHand>(
      [learner = options.learner, from = twin::readSearchingSkill(options.learner.from),
       to = twin::readSearchingSkill(options.learner.to), seen, X_ET](int trial) {
        return twin::searchingHand(between(from, to, learner.level(trial)), seen, X_ET,
                                   learner.seed + static_cast<std::uint64_t>(trial - 1));
      });
}

/// The probe points down.
Mat3 downward() { return Eigen::AngleAxisd(std::acos(-1.0), Vec3::UnitX()).toRotationMatrix(); }

}  // namespace

SearchWorld::SearchWorld(const SessionOptions& options)
    : station(searchStation(options)),
      task(task_search::readSearch(options.task.empty() ? station::assetFile("tasks/search.json")
                                                        : std::filesystem::path(options.task))),
      rendering(task_search::renderingOn(task, station)),
      plate(anatomy::phantomBlock(plateSize(task), task.title)),
      X_WA(station.floor->X_WF * anatomy::X_AP().inverse()),
      X_AF(anatomy::X_AP()),
      episodes(episodesFor(options, task)) {}

haptics::TickConfig SearchWorld::tickConfig(const SessionOptions& options) const {
  haptics::TickConfig config;
  config.engine = haptics::Engine::floor;
  config.coupling = station.coupling;
  config.safety = station.safety;
  config.passivity = station.passivity;
  config.X_ET = pack(station.X_ET);
  config.X_DF = pack(Pose(station.X_WD.inverse() * station.floor->X_WF));
  config.floor = rendering;
  config.augmentations = station::onDevice(task.augmentations, station.safety.max_force_N,
                                           station.coupling.stiffness, rendering.unit);
  config.period_ns = std::llround(1e9 / options.rate_Hz);
  if (onBench()) config.safety.deadman_button = 0;  // nobody could hold it
  config.device_turns = 1;
  return config;
}

SessionDevices::Hands SearchWorld::hands(const SessionOptions& options) const {
  twin::VisibleFloor seen;
  seen.X_AF = X_AF;
  seen.magnification = magnification();
  seen.unit = rendering.unit;
  seen.handle_mass = station.device.capabilities.apparent_mass;
  seen.start_height = rendering.start_height;
  seen.circle = task.spec.circle;
  seen.disc = task.spec.disc;
  seen.groove = task.spec.groove + task.spec.groove_half_width;
  const Pose X_WF = station.floor->X_WF,
             X_WT =
                 X_WF * makePose(downward(), Vec3(0, 0, rendering.start_height * rendering.unit));
  twin::VirtualBench::Setup bench{station,
                                  searchingHandOf(options, seen, station.X_ET),
                                  station.X_WD.inverse() * X_WT * station.X_ET.inverse(),
                                  X_WF.translation(),
                                  X_WF.linear() * Vec3::UnitZ(),
                                  options.benchSeed(),
                                  {},
                                  nullptr,
                                  {},
                                  {}};
  return {std::move(bench), std::nullopt, 0};
}

record::SessionInfo SearchWorld::info(const SessionOptions& options) const {
  record::SessionInfo info;
  info.uuid = options.uuid;
  info.started_utc = utcNow();
  info.software = std::string("palpa ") + PALPA_VERSION;
  info.command = options.command;
  info.session_json = sessionText({{"seed", options.seed},
                                   {"bench_seed", options.benchSeed()},
                                   {"operator", nameOf(options.who)},
                                   {"simulated", simulated(options)},
                                   {"mode", options.mode},
                                   {"trainee", options.trainee},
                                   {"force_feedback", options.force_feedback},
                                   {"virtual_time", options.fast},
                                   {"assessed", options.assess}},
                                  options);
  info.station_json = station.file.json().dump();
  info.task_json = task.source;
  info.tick_config = tickConfig(options);
  return info;
}

SearchRun runSearch(const SessionOptions& options, const SearchWorld& world,
                    const std::filesystem::path& folder) {
  task_search::SearchChannels channels(options.fast ? runtime::TimeMode::virtual_time
                                                    : runtime::TimeMode::real);
  const haptics::TickConfig tick = world.tickConfig(options);
  task_search::Floors floors(world.task, world.episodes);
  SessionFrame frame(options, {world.station, world.plate, world.X_WA, tick, {}, false, &floors},
                     world.hands(options), channels, folder);
  const std::string not_scored =
      world.station.calibration_verdict == "pass" ? "" : world.station.calibration_verdict;
  task_search::SearchTask task(
      {world.task, tick, world.simulated(options), options.who != OperatorKind::person,
       options.force_feedback, options.fast, not_scored, world.episodes, frame.places(),
       options.role},
      floors, frame.bus(), channels, frame.executive());
  task_search::SearchScene scene(
      {frame.stage(), world.station.floor->X_WF, world.X_AF,
       world.task.spec.side * world.rendering.unit, world.magnification()},
      frame.bus(), channels);
  SearchRun run;
  static_cast<SessionRun&>(run) = frame.run(task, scene, world.info(options));
  run.trials = task.completed();
  return run;
}

}  // namespace palpa::cli
