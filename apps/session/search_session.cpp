#include "apps/session/search_session.h"
#include "apps/runtime/clock.h"
#include "apps/training/trial_words.h"

#include <cstdio>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/parametric/phantoms.h"
#include "apps/evidence/search_figures.h"
#include "apps/report/search/search_report.h"
#include "apps/session/output_folder.h"
#include "apps/session/session_facts.h"
#include "apps/station/assets.h"
#include "apps/task_search/search_scene.h"
#include "apps/twin/learning_hand.h"

namespace palpa::session {
namespace {

using assess::SearchMode;

constexpr double kPlateThick = 0.02;  // m, as shown
constexpr SearchMode kModes[] = {SearchMode::real, SearchMode::degraded, SearchMode::augmented};

station::Station searchStation(const SessionOptions& options) {
  station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/search_bench.json")
                              : std::filesystem::path(options.station));
  station::judgeAge(station, runtime::utcNow());
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
    return twin::searchingHand(twin::readSearchingSkill(operatorFile(options, "search_")), seen,
                               X_ET, options.seed);
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
  config.contact_mode = haptics::ContactMode::floor;
  config.coupling = station.coupling;
  config.safety = station.safety;
  config.passivity = station.passivity;
  config.X_ET = pack(station.X_ET);
  config.X_DF = pack(Pose(station.X_WD.inverse() * station.floor->X_WF));
  config.floor = rendering;
  config.augmentations = station::onDevice(task.augmentations, station, rendering.unit);
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
  twin::VirtualBenchSetup bench{
      .station = station,
      .hand = searchingHandOf(options, seen, station.X_ET),
      .X_DE_start = station.X_WD.inverse() * X_WT * station.X_ET.inverse(),
      .watched_W = X_WF.translation(),
      .normal_W = X_WF.linear() * Vec3::UnitZ(),
      .seed = options.benchSeed()};
  return {std::move(bench), std::nullopt, 0};
}

record::SessionInfo SearchWorld::info(const SessionOptions& options) const {
  record::SessionInfo info =
      infoOf(options, head(options), task.source, nlohmann::json::object({{"mode", options.mode}}));
  info.station_json = station.file.json().dump();
  info.tick_config = tickConfig(options);
  return info;
}

SearchRun runSearch(const SessionOptions& options, const SearchWorld& world,
                    const std::filesystem::path& folder) {
  task_search::SearchChannels channels(options.fast ? runtime::TimeMode::virtual_time
                                                    : runtime::TimeMode::real);
  const haptics::TickConfig tick = world.tickConfig(options);
  task_search::Floors floors(world.task, world.episodes);
  SessionFrame frame(
      options,
      {training::Engine::search, world.station, world.plate, world.X_WA, tick, {}, false, &floors},
      world.hands(options), channels, folder);
  task_search::SearchTask task({.settings = world.task,
                                .tick = tick,
                                .simulated = world.simulated(options),
                                .automatic = options.who != OperatorKind::person,
                                .force_feedback = options.force_feedback,
                                .waits = options.fast,
                                .not_scored = world.station.calibrationProblem(),
                                .episodes = world.episodes,
                                .places = frame.places(),
                                .role = options.role},
                               floors, frame.bus(), channels, frame.executive());
  task_search::SearchScene scene({.stage = frame.stage(),
                                  .X_WF = world.station.floor->X_WF,
                                  .X_AF = world.X_AF,
                                  .side = world.task.spec.side * world.rendering.unit,
                                  .magnification = world.magnification()},
                                 frame.bus(), channels);
  SearchRun run;
  task.isFor(world.task.brief);
  static_cast<SessionRun&>(run) = frame.run(task, scene, world.info(options));
  run.trials = task.completed();
  return run;
}

namespace {

/// How strong attractions are at most, on this device and with this unit; grooves and pits are
/// valleys of the same radius.
std::vector<report::Fact> pullFacts(const SearchWorld& world) {
  const double radius = world.task.spec.bottom_radius,
               steepest = world.station.device.capabilities.stable_stiffness;
  std::vector<report::Fact> facts;
  const station::NamedPlan& named = world.task.augmentations;
  for (std::size_t i = 0; i < named.plan.count; ++i) {
    const haptics::Augmentation& a = named.plan.each[i];
    if (a.kind != haptics::AugmentationKind::attraction) continue;
    const double reach = named.reach_U[i] > 0 ? world.rendering.unit * named.reach_U[i] : a.reach;
    const auto peak = [&](double amplitude) { return 2 * amplitude / radius; };
    facts.push_back(
        {"Pull into valleys, at most",
         format("%.1f N", peak(haptics::attractionHeld(a.amplitude, reach, radius, steepest))),
         format("of %.1f N that the task asks for: no steeper than the device's %.0f N/m, with "
                "1 U = %.3g mm",
                peak(a.amplitude), steepest, 1e3 * world.rendering.unit)});
  }
  return facts;
}

}  // namespace

ReportHead SearchWorld::head(const SessionOptions& options) const {
  ReportHead head = headOf(options, task.title, task.taxonomy, station, simulated(options));
  head.unit_note = format("1 U = %.3g mm in the hand: the floor is %.1f mm wide",
                          1e3 * rendering.unit, 1e3 * rendering.unit * task.spec.side);
  head.station.push_back({"Stiffness of the floor",
                          format("%.0f N/m, degraded %.0f N/m", rendering.real.stiffness,
                                 rendering.degraded.stiffness),
                          ""});
  for (report::Fact& fact : pullFacts(*this)) head.station.push_back(std::move(fact));
  head.parts = meaningsOf(task.augmentations);
  head.doses = noDoses(tickConfig(options).augmentations, task.augmentations);
  return head;
}

void writeSearchResults(const ReportHead& head,
                        const std::vector<task_search::CompletedSearch>& trials,
                        const ReportTail& tail, const std::filesystem::path& session_file) {
  report::SearchReport page;
  std::vector<assess::SearchTrial> written;
  for (const task_search::CompletedSearch& trial : trials) {
    page.trials.push_back(trial.trial);
    if (counts(trial.trial)) written.push_back(trial.trial);
  }
  const std::filesystem::path folder = session_file.parent_path();
  report::writeSearchCsv(head.user_id, written, folder / "trials.csv", head.doses);
  if (!head.page) return;
  static_cast<report::SessionPage&>(page) = pageOf(
      head, tail, session_file, training::Engine::search, judgedOf(trials, [&](const auto& t) {
        return progress::JudgedTrial{t.trial.role, t.trial.outcome, assess::searchMetrics(t.trial)};
      }));
  page.subtasks = head.parts;
  page.pictures = picturesOf(tail);
  page.unit_note = head.unit_note;
  const record::SessionReader reader(session_file);
  if (evidence::hasSearchFigures(reader)) page.figures = evidence::searchFigures(reader);
  report::writeSearchReport(page, folder / "report.html");
}

void writeSearchOutcome(const SessionOptions& options, const SearchWorld& world,
                        const SearchRun& run, const std::filesystem::path& folder) {
  writeSearchResults(world.head(options), run.trials, {run.pictures, runNotes(run)},
                     folder / "session.palpa");

  const char* simulated = world.simulated(options) ? ", simulated" : "";
  for (const task_search::CompletedSearch& trial : run.trials)
    std::printf("Episode %d (%s, %s%s): %s\n", trial.trial.trial, name(trial.trial.mode),
                training::nameOf(trial.trial.role).c_str(), simulated,
                trial.reason.empty() ? summaryOf(trial.trial).c_str() : trial.reason.c_str());
  std::vector<assess::SearchTrial> trials;
  for (const task_search::CompletedSearch& trial : run.trials) trials.push_back(trial.trial);
  for (const assess::SearchTally& tally : assess::talliesOf(trials))
    std::printf("%s%s%s: found in %d of %d episodes\n", tally.block.c_str(),
                tally.block.empty() ? "" : ", ", name(tally.mode), tally.found, tally.episodes);
  if (options.report)
    sayWritten(run, folder, "how often and how fast the target was found", "scored episode");
}

}  // namespace palpa::session
