#include "apps/session/palpation_session.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

#include "apps/report/palpation/palpation_report.h"
#include "apps/session/mouse_hands.h"
#include "apps/session/output_folder.h"
#include "apps/station/assets.h"
#include "apps/task_palpation/palpation_place.h"
#include "apps/task_palpation/palpation_scene.h"
#include "apps/task_palpation/palpation_task.h"
#include "apps/training/trial_words.h"
#include "apps/twin/feeling_hands.h"
#include "apps/twin/soft_samples.h"

namespace palpa::session {
namespace {

constexpr double kPickedUp = 0.05;                      // m above the phantom
constexpr double kBeside = 0.02;                        // m, of the second finger
constexpr std::int64_t kTrackerSilent_ns = 50'000'000;  // some periods of a slow tracker [chosen]

/// What anybody sees or has learnt of the phantom.
twin::VisiblePhantom visible(const task_palpation::PalpationSettings& task) {
  const auto from_normal = [normal = task.scoring.rules.normal](const Vec3& p_P) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const assess::NormalAnatomy& one : normal)
      nearest = std::min(nearest, assess::fromLine(one, p_P));
    return nearest;
  };
  const assess::SearchArea& area = task.scoring.rules.area;
  twin::VisiblePhantom seen{anatomy::X_AP(), area.half_x, area.half_y, from_normal};
  seen.top = area.top;
  seen.longer = assess::foreshortening(area);
  if (!area.outline.empty())
    seen.to_area = [area](const Vec3& p_P) { return assess::nearestIn(area, p_P); };
  return seen;
}

}  // namespace

PalpationWorld::PalpationWorld(const SessionOptions& options)
    : station(feelingStation(options)),
      task(task_palpation::readPalpation(options.task.empty()
                                             ? station::assetFile("tasks/palpation_breast.json")
                                             : std::filesystem::path(options.task))),
      phantom(task_palpation::shownPhantom(task.size, task.title, task.scoring.rules.area,
                                           task.seen_as)),
      X_WA(station.sample->X_WP * anatomy::X_AP().inverse()) {
  task.library = libraryOn(options, station, std::move(task.library));
  if (std::abs(station.sample->tip_radius - task.library.tip_radius) > 1e-6)
    station.file.refuse("sample/tip_radius_mm",
                        "is not that of the tip with which the task's lumps were identified");
  if (task.real) task.real->share = takenLimit(options.rate_Hz).share();
  if (task.real && !options.surface.empty())
    throw UsageError("lies in the silicone of its task", "A real lump, with --surface",
                     "Leave one of them out");
  if (task.real && onBench() && task.real->lump.p_P.head<2>().norm() > 1e-6)
    throw UsageError("is in the middle of the bench's samples", "real_lump", "Give 0 and 0");
  if (!onBench() && (station.safety.deadman_button & task_palpation::PalpationListener::kMark))
    station.file.refuse("safety/deadman_button", "is the button that marks a lump; give another");
}

station::TakenLimit PalpationWorld::takenLimit(double rate_Hz) const {
  return station::takenLimit(station, task.library, task.real->lump.kind,
                             task.scoring.rules.too_hard, rate_Hz);
}

std::vector<report::Fact> PalpationWorld::takenFacts(const SessionOptions& options) const {
  std::vector<report::Fact> facts = steadyingFacts(options, task.augmentations, station);
  if (task.real)
    facts.push_back({"A real lump, taken away in " + format("%.0f %%", 100 * task.real->taken_in) +
                         " of the cases",
                     station::inWords(takenLimit(options.rate_Hz)),
                     task.library.kinds[task.real->lump.kind].name + ", in the phantom"});
  return facts;
}

void PalpationWorld::checkFingers(const SessionOptions& options) const {
  if (options.tracked_finger && options.tools < 2)
    throw UsageError("is of a second finger", "--second finger", "Add --tools 2");
  if (options.tools < 2) return;
  if (!station.second_X_WD)
    throw UsageError("has no \"second_device\"", station.file.name(),
                     "--tools 2 needs a device for each finger: describe the second one");
  if (station.device.driver != station::DeviceDriver::bench || options.who == OperatorKind::person)
    throw UsageError("can only be simulated so far", "--tools 2",
                     "Leave out --station, take --operator expert or novice");
  if (!task.scoring.rules.area.top.flat())
    throw UsageError("is for a flat top so far", "--tools 2",
                     "Leave it out, or choose breast, abdomen or prostate (--preset)");
  if (options.augment || task.real)
    throw UsageError("changes what one tool feels",
                     options.augment ? "--augment on with --tools 2" : "A real lump, --tools 2",
                     "Leave one of them out");
}

haptics::TickConfig PalpationWorld::tickConfig(const SessionOptions& options) const {
  haptics::TickConfig config = sensedTick(options, station, task.library);
  config.top = task.scoring.rules.area.top;
  config.augmentations = station::onDevice(task.augmentations, station);
  for (std::size_t i = 0; i < task.library.kinds.size(); ++i)
    config.lump_radius[i] = task.library.kinds[i].diameter / 2;
  return config;
}

std::optional<haptics::PairConfig> PalpationWorld::pairConfig(const SessionOptions& options) const {
  if (options.tools < 2) return std::nullopt;
  haptics::PairConfig pair;
  pair.tools.fill(tickConfig(options));
  pair.tools[1].X_DP = pack(Pose(station.second_X_WD->inverse() * station.sample->X_WP));
  if (options.tracked_finger) {
    pair.estimated = 1;
    pair.tools[1].safety.silent_ns = kTrackerSilent_ns;
  }
  return pair;
}

SessionDevices::Hands PalpationWorld::hands(const SessionOptions& options) const {
  const twin::PalpatingSkill skill = twin::readPalpatingSkill(operatorFile(options, "palpation_"));
  const twin::VisiblePhantom seen = visible(task);
  const Pose& X_WP = station.sample->X_WP;
  auto person =
      options.who == OperatorKind::person && onBench()
          ? std::make_unique<PointingHand>(PointingHandSetup{.X_DP = station.X_WD.inverse() * X_WP,
                                                             .X_ET = station.X_ET,
                                                             .X_AP = anatomy::X_AP(),
                                                             .half_x = seen.half_x,
                                                             .half_y = seen.half_y,
                                                             .grip = skill.grip,
                                                             .top = seen.top,
                                                             .to_area = seen.to_area})
          : nullptr;
  PointingHand* const pointing = person.get();
  auto fingers = twin::palpatingFingers(skill, seen, station.X_ET, options.tools, options.seed);
  std::unique_ptr<twin::Hand> hand = std::move(person);
  if (!hand) hand = std::move(fingers[0]);
  const auto pickedUp = [&](double beside) {
    return Pose(X_WP *
                makePose(Eigen::AngleAxisd(std::acos(-1.0), Vec3::UnitX()).toRotationMatrix(),
                         Vec3(beside, -task.scoring.rules.area.half_y, kPickedUp)));
  };
  twin::VirtualBenchSetup bench{
      .station = station,
      .hand = std::move(hand),
      .X_DE_start = station.X_WD.inverse() * pickedUp(0) * station.X_ET.inverse(),
      .watched_W = X_WP.translation(),
      .normal_W = X_WP.linear() * Vec3::UnitZ(),
      .seed = options.benchSeed()};
  if (options.tools == 2)
    bench.second = twin::SecondTool{
        .hand = std::move(fingers[1]),
        .X_WD = *station.second_X_WD,
        .X_DE_start = station.second_X_WD->inverse() * pickedUp(kBeside) * station.X_ET.inverse(),
        .tracker = options.tracked_finger ? std::optional(twin::FingerTracker{}) : std::nullopt};
  if (onBench()) {
    const auto sample = std::make_shared<twin::SampleTwin>(
        station, task.real ? task.library.kinds[task.real->lump.kind].name : options.surface,
        options.benchSeed(), task.scoring.rules.area.top);
    if (options.tools == 2 && !sample->forTwo())
      throw UsageError("can be felt with one tool only", "--surface \"" + options.surface + '"',
                       "Leave out --tools 2, or choose another");
    const bool two = options.tools == 2;
    bench.real_thing = [sample, two](const std::array<Pose, 2>& X_WT_true, double dt) {
      const auto felt = [](const twin::SampleTouch& touch) {
        return twin::RealTouch{touch.f_W, touch.p_W};
      };
      if (!two) return std::array<twin::RealTouch, 2>{felt(sample->step(X_WT_true[0], dt)), {}};
      const std::array<twin::SampleTouch, 2> touches = sample->step(X_WT_true, dt);
      return std::array<twin::RealTouch, 2>{felt(touches[0]), felt(touches[1])};
    };
  }
  return {std::move(bench), std::nullopt, task.library.tip_radius, pointing};
}

std::optional<scene::SurfaceMap> PalpationWorld::shownMap(const SessionOptions& options) const {
  if (!task.library.map || !options.show_map || options.guidance) return std::nullopt;
  return task_palpation::shownMap(*task.library.map, anatomy::X_AP());
}

record::SessionInfo PalpationWorld::info(const SessionOptions& options) const {
  nlohmann::json own{{"guidance", options.guidance},
                     {"see_through", options.see_through},
                     {"augment", options.augment},
                     {"tools", options.tools},
                     {"second", options.tracked_finger ? "finger" : "device"}};
  if (task.library.map) own["map"] = station::jsonOf(*task.library.map);
  record::SessionInfo info = infoOf(options, head(options), task.source, std::move(own));
  info.station_json = station.file.json().dump();
  info.tick_config = tickConfig(options);
  info.pair_config = pairConfig(options);
  return info;
}

namespace {

/// Empty: trials count.
std::string whyUnscored(const SessionOptions& options, const PalpationWorld& world) {
  if (!world.station.calibrated()) return world.station.calibration_verdict;
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
    plan.push_back({scored ? options.role : training::Role::not_scored,
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
  const std::optional<haptics::PairConfig> pair = world.pairConfig(options);
  SessionFrame frame(
      options, {training::Engine::palpation, world.station, world.phantom, world.X_WA, tick, pair},
      world.hands(options), channels, folder);
  task_palpation::PalpationTask task({.settings = world.task,
                                      .tick = tick,
                                      .pair = pair,
                                      .simulated = world.simulated(options),
                                      .automatic = options.who != OperatorKind::person,
                                      .see_through = options.see_through,
                                      .guided = options.guidance,
                                      .not_scored = whyUnscored(options, world),
                                      .plan = planOf(options, world),
                                      .places = frame.places()},
                                     frame.bus(), channels, frame.executive());
  const auto second =
      pair ? std::optional<Pose>(anatomy::X_AP() * unpack(pair->tools[1].X_DP).inverse())
           : std::nullopt;
  task_palpation::PalpationScene scene({.stage = frame.stage(),
                                        .X_AP = anatomy::X_AP(),
                                        .area = world.task.scoring.rules.area,
                                        .tip_radius = world.task.library.tip_radius,
                                        .force_note = world.forceNote(),
                                        .X_AD2 = second,
                                        .estimated = options.tracked_finger,
                                        .map = world.shownMap(options)},
                                       frame.bus(), channels);
  PalpationRun run;
  task.isFor(world.task.brief);
  static_cast<SessionRun&>(run) = frame.run(task, scene, world.info(options));
  run.trials = task.completed();
  return run;
}

namespace {

std::vector<report::PalpationPage> pagesOf(
    const assess::PalpationRules& rules,
    const std::vector<task_palpation::CompletedPalpation>& trials,
    const std::vector<trial::SavedPicture>& pictures, bool estimated) {
  std::vector<report::PalpationPage> pages;
  for (const auto& trial : trials) {
    report::PalpationPage page{trial.assessment, {}, rules, {}, estimated};
    for (const trial::SavedPicture& p : pictures)
      if (p.moment.trial == trial.assessment.facts.trial)
        page.pictures.push_back({p.file, p.moment.caption, p.moment.t_s});
    pages.push_back(std::move(page));
  }
  return pages;
}

}  // namespace

std::string PalpationWorld::forceNote() const {
  const double deep = task.scoring.rules.levels.back(), clinical = task.clinical_force_N;
  if (clinical <= 0) return format("Deep is %.1f N here", deep);
  if (station.safety.max_force_N >= clinical && deep >= clinical) return "";
  return format("Scaled force: deep is %.1f N here, about %.0f N on a patient", deep, clinical);
}

ReportHead PalpationWorld::head(const SessionOptions& options) const {
  ReportHead head = headOf(options, task.title, task.taxonomy, station, simulated(options));
  head.force_note = forceNote();
  head.station.push_back(surfaceFact(task.library));
  for (report::Fact& fact : fingerFacts(options)) head.station.push_back(std::move(fact));
  for (report::Fact& fact : lumpFacts(task.library)) head.station.push_back(std::move(fact));
  for (report::Fact& fact : takenFacts(options)) head.station.push_back(std::move(fact));
  head.parts = meaningsOf(task.augmentations);
  head.doses = noDoses(tickConfig(options).augmentations, task.augmentations);
  return head;
}

void writePalpationResults(const ReportHead& head,
                           const std::vector<task_palpation::CompletedPalpation>& trials,
                           const task_palpation::Scoring& scoring, const ReportTail& tail,
                           const std::filesystem::path& evidence) {
  std::vector<assess::PalpationAssessment> judged;
  for (const auto& trial : trials)
    if (trial.assessment.facts.outcome != training::Outcome::voided &&
        training::countsAsScored(trial.assessment.facts.role))
      judged.push_back(trial.assessment);
  const std::filesystem::path folder = evidence.parent_path();
  report::writePalpationCsv(head.user_id, judged, folder / "trials.csv", head.doses);
  if (!head.page) return;
  report::PalpationReport page;
  static_cast<report::SessionPage&>(page) = pageOf(
      head, tail, evidence, training::Engine::palpation, judgedOf(trials, [&](const auto& t) {
        return progress::JudgedTrial{t.assessment.facts.role, t.assessment.facts.outcome,
                                     assess::palpationMetrics(t.assessment)};
      }));
  page.force_note = head.force_note;
  const auto pair = record::SessionReader(evidence).info().pair_config;
  page.trials = pagesOf(scoring.rules, trials, tail.pictures, pair && pair->estimated);
  page.courses = palpationCourses(evidence);
  page.standard = scoring.standard;
  page.parts = partsOf(head.parts, trials, [](const auto& t) {
    return std::tuple(t.assessment.doses, t.assessment.facts.augmented, t.assessment.score.seconds);
  });
  report::writePalpationReport(page, folder / "report.html");
}

void writePalpationOutcome(const SessionOptions& options, const PalpationWorld& world,
                           const PalpationRun& run, const std::filesystem::path& folder) {
  writePalpationResults(world.head(options), run.trials, world.task.scoring,
                        {run.pictures, runNotes(run)}, folder / "session.palpa");
  for (const auto& trial : run.trials) {
    const assess::PalpationAssessment& a = trial.assessment;
    std::printf("Trial %d (%s%s): %s\n", a.facts.trial, training::nameOf(a.facts.role).c_str(),
                a.facts.simulated ? ", simulated" : "",
                trial.reason.empty() ? a.summary.c_str() : trial.reason.c_str());
  }
  if (options.report)
    sayWritten(run, folder, "what was found and felt, with reasons and pictures", "scored trial");
}

}  // namespace palpa::session
