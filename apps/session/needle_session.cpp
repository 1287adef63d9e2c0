#include "apps/session/needle_session.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "apps/assess/needle/aspiration.h"
#include "apps/record/session_file.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/session/needle_world.h"
#include "apps/session/stage.h"
#include "apps/station/overlay_error.h"
#include "apps/task_needle/near_miss_watch.h"
#include "apps/training/trial_words.h"

namespace palpa::session {
namespace {

constexpr std::uint64_t kFamiliarisationSeed = 1'000'000;  // another skin than the scored trials

/// Empty: trials count.
std::string whyNotScored(const SessionOptions& options, const NeedleWorld& world) {
  if (!world.station.calibrated()) return world.station.calibration_verdict;
  if (!world.station.device.capabilities.has_orientation)
    return "the device does not measure how the needle is held";
  if (!world.not_scored.empty()) return world.not_scored;
  if (options.guide) return "the guide line to the vein was shown";
  return "";
}

std::vector<task_needle::TrialPlan> plan(const SessionOptions& options, const NeedleWorld& world,
                                         bool person) {
  const bool scored = whyNotScored(options, world).empty();
  std::vector<task_needle::TrialPlan> trials;
  if (person && options.familiarisation)
    trials.push_back(world.trial(training::Role::familiarisation,
                                 options.seed + kFamiliarisationSeed, options.force_feedback,
                                 false));
  for (int i = 0; i < options.trials; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    trials.push_back(world.trial(scored ? options.role : training::Role::not_scored, seed,
                                 options.force_feedback, options.augment));
    trials.back().most_passes =
        options.assess ? world.task.most_passes.assessed : world.task.most_passes.practice;
  }
  return trials;
}

/// Of a real device the buttons that do nothing else, in their order.
std::array<std::uint32_t, 3> answerButtons(const station::Station& station) {
  std::array<std::uint32_t, 3> answers{};
  if (station.device.driver != station::DeviceDriver::real) return answers;
  const std::uint32_t used = station.device.plunger_button | station.safety.deadman_button;
  std::size_t given = 0;
  for (std::uint32_t button = 1; button <= 8 && given < answers.size(); button <<= 1)
    if (!(button & used)) answers[given++] = button;
  return answers;
}

/// What whoever held a recorded device said of what was aspirated.
std::vector<std::pair<std::int64_t, assess::Taken>> saidIn(const station::Station& station) {
  std::vector<std::pair<std::int64_t, assess::Taken>> said;
  if (station.device.driver != station::DeviceDriver::replay) return said;
  for (const runtime::Event& event : record::SessionReader(station.device.recording).events())
    if (event.is(runtime::EventKind::answer) && event.value >= 1 && event.value <= 3)
      said.emplace_back(event.t_ns, static_cast<assess::Taken>(static_cast<int>(event.value) - 1));
  return said;
}

/// Where the task is about blood, as an artery's pulses: a bone has no heart.
std::optional<double> heartOf(const NeedleWorld& world) {
  return world.task.goal ? std::nullopt : std::optional(assess::kHeart_per_min);
}

int skinOf(const anatomy::Patient& patient) {
  const anatomy::OrganSurface& skin = patient.organ(Organ::skin);
  return static_cast<int>(&skin - patient.organs.data());
}

/// What is the needle's in a session.
class NeedleSession {
 public:
  NeedleSession(const SessionOptions& options, NeedleWorld& world,
                const std::filesystem::path& folder, SessionCost* cost)
      : options_(options), world_(world), folder_(folder), cost_(cost) {
    MouseHand* mouse = frame_.devices().mouse();
    if (mouse && head_.view)
      head_.view->onHeld([this, mouse](const headset::HeldController& held) {
        mouse->hold(held, frame_.executive().clock().now());
      });
  }

  SessionResult run() {
    SessionResult result;
    task_.isFor(world_.task.brief);
    static_cast<SessionRun&>(result) =
        frame_.run(task_, scene_, sessionInfo(options_, world_), &geometry_);
    result.trials = task_.completed();
    if (options_.headset) result.devices.push_back(head_.fact());
    return result;
  }

 private:
  task_needle::NeedleTaskSetup taskSetup() const {
    const bool person = options_.who == OperatorKind::person;
    return {.patient = world_.patient,
            .query = world_.query,
            .settings = world_.task,
            .taught_path = world_.taught_path ? &*world_.taught_path : nullptr,
            .X_AD = world_.X_DA.inverse(),
            .X_ET = pack(world_.station.X_ET),
            .simulated = isSimulated(options_, world_),
            .automatic = !person,
            .calibration_problem = whyNotScored(options_, world_),
            .plan = plan(options_, world_, person),
            .places = frame_.places(),
            .augmentations = world_.tickConfig().augmentations,
            .fixtures = world_.fixtures(),
            .answers = answerButtons(world_.station),
            .said = saidIn(world_.station)};
  }

  task_needle::NeedleSceneSetup sceneSetup() {
    task_needle::NeedleSceneSetup setup{
        .stage = stageSetup(),
        .giving_way = options_.skin_deflection ? &world_.query : nullptr,
        .skin = skinOf(world_.patient),
        .guide = {},
        .words = world_.task.words};
    if (options_.guide)
      setup.guide = scene::GuideLine{world_.patient.landmark(anatomy::landmark::kEntry),
                                     world_.patient.landmark(anatomy::landmark::kVeinTarget)};
    return setup;
  }

  trial::TrialScene::Stage stageSetup() {
    trial::TrialScene::Stage setup = frame_.stage(head_.view.get());
    for (std::size_t i = 0; i < world_.real_things.size(); ++i)
      setup.things.push_back({&world_.real_things[i], &world_.station.things[i]});
    if (station::calibrationOf(world_.station.calibrations, station::CalibrationKind::registration))
      setup.tip_covariance_A = [this](const Pose& X_DT) { return tipCovariance(X_DT); };
    if (MouseHand* mouse = frame_.devices().mouse(); mouse && setup.input)
      setup.input = [this, mouse](const scene::ViewInput& input, std::int64_t now_ns) {
        if (head_.view && !head_.view->trouble().empty()) mouse->letGo(now_ns);
        mouse->handle(input, now_ns);
      };
    return setup;
  }

  /// Of the drawn tip against the real one, in A.
  std::optional<Mat3> tipCovariance(const Pose& X_DT) const {
    const auto S_W =
        station::predictTipCovariance(world_.station, X_DT * world_.station.X_ET.inverse());
    const Mat3 R_AW = world_.X_WA.rotation().transpose();
    return S_W ? std::optional<Mat3>(R_AW * *S_W * R_AW.transpose()) : std::nullopt;
  }

  /// Of the evidence's records as they come.
  std::string nearMiss(const haptics::FlightRecord& record) {
    const Pose X_DT =
        unpack(PackedPose{record.reading.p_DE, record.reading.q_DE}) * world_.station.X_ET;
    return near_.look(world_.X_DA.inverse() * X_DT.translation(),
                      record.phase == haptics::NeedlePhase::inserted, record.commands.trial);
  }

  const SessionOptions& options_;
  NeedleWorld& world_;
  const std::filesystem::path folder_;
  SessionCost* const cost_;
  task_needle::TaskChannels channels_{options_.fast ? runtime::TimeMode::virtual_time
                                                    : runtime::TimeMode::real};
  task_needle::NearMissWatch near_{world_.patient, world_.query};
  SessionFrame frame_{
      options_,
      {.engine = training::Engine::needle,
       .station = world_.station,
       .patient = world_.patient,
       .X_WA = world_.X_WA,
       .tick = tickConfig(options_, world_),
       .near = [this](const haptics::FlightRecord& record) { return nearMiss(record); },
       .heart_per_min = heartOf(world_),
       .cost = cost_},
      needleHands(options_, world_),
      channels_,
      folder_};
  const HeadStage head_ = makeHeadStage(options_, world_.patient, world_.X_WA, frame_.desktop());
  runtime::GeometryActivity geometry_{frame_.bus(), world_.geometry, world_.X_DA};
  task_needle::NeedleTask task_{taskSetup(), frame_.bus(), channels_, frame_.executive()};
  task_needle::NeedleScene scene_{sceneSetup(), frame_.bus(), channels_};
};

}  // namespace

SessionResult runNeedleSession(const SessionOptions& options, NeedleWorld& world,
                               const std::filesystem::path& folder, SessionCost* cost) {
  return std::make_unique<NeedleSession>(options, world, folder, cost)->run();
}

}  // namespace palpa::session
