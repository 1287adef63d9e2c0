#include "apps/cli/needle_session.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/cli/head_stage.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/needle_hands.h"
#include "apps/cli/progress.h"
#include "apps/cli/session_info.h"
#include "apps/cli/stage.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"
#include "apps/runtime/recorder_activity.h"
#include "apps/runtime/video_recorder.h"
#include "apps/station/overlay_error.h"

namespace palpa::cli {
namespace {

constexpr std::uint64_t kFamiliarisationSeed = 1'000'000;  // another skin than the scored trials

/// Empty: trials count.
std::string whyNotScored(const SessionOptions& options, const NeedleWorld& world) {
  if (world.station.calibration_verdict != "pass") return world.station.calibration_verdict;
  if (!world.station.device.capabilities.has_orientation)
    return "the device does not measure how the needle is held";
  if (options.guide) return "the guide line to the vein was shown";
  return "";
}

std::vector<task_needle::TrialPlan> plan(const SessionOptions& options, const NeedleWorld& world,
                                         bool person) {
  const bool scored = whyNotScored(options, world).empty();
  std::vector<task_needle::TrialPlan> trials;
  if (person && options.familiarisation)
    trials.push_back(world.trial("familiarisation", options.seed + kFamiliarisationSeed, options.force_feedback));
  for (int i = 0; i < options.trials; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    trials.push_back(world.trial(scored ? options.role : "not scored", seed, options.force_feedback));
  }
  return trials;
}

std::string markFor(OperatorKind who, const station::Station& station) {
  if (isSimulated(who)) return "SIMULATED OPERATOR";
  if (who == OperatorKind::recorded) return "RECORDED HAND";
  if (!station.simulated) return "";
  return station.device.driver == station::DeviceDriver::bench ? "VIRTUAL BENCH" : "VIRTUAL CAMERA";
}

int skinOf(const anatomy::Patient& patient) {
  const anatomy::OrganSurface& skin = patient.organ(Organ::skin);
  return static_cast<int>(&skin - patient.organs.data());
}

/// Every part of a session, made in the order in which one needs the other; the evidence file last: a mistake in the
/// set-up leaves none behind.
class NeedleSession {
 public:
  NeedleSession(const SessionOptions& options, NeedleWorld& world, const std::filesystem::path& folder)
      : options_(options), world_(world), folder_(folder) {
    if (options.record_video) video_.emplace(folder);
    if (devices_.mouse()) devices_.mouse()->onSkinKey([this] { scene_.cycleSkin(); });
    if (devices_.mouse() && head_.view) head_.view->onHeld([this](const headset::HeldTool& held) { devices_.mouse()->hold(held, executive_->clock().now()); });
    devices_.addTo(*executive_);
    executive_->add(haptic_, {1, true, false, options.cpu});
    if (!options.exact_geometry) executive_->add(geometry_, {2, false, false});
    executive_->add(camera_, {3, false, false});
    executive_->add(task_, {4, false, false});
    executive_->add(scene_, {5, false, true});
    executive_->add(recorder_, {6, false, false});
    executive_->add(progress_, {7, false, false});
    executive_->add(interrupt_, {8, false, false});
  }

  SessionResult run() {
    executive_->run();
    scene_.finish(executive_->clock().now());
    recorder_.finish();
    writer_.close();
    SessionResult result;
    result.trials = task_.completed();
    result.pictures = scene_.pictures();
    result.lateness = executive_->lateness();
    if (pictures_.fromBench()) result.accuracy = devices_.bench()->accuracy();
    if (video_) result.video = {video_->pictures(), video_->trouble()};
    result.registration = pictures_.registration();
    result.camera_remarks = pictures_.remarks();
    result.board = scene_.board();
    result.devices = devices_.facts();
    if (options_.headset) result.devices.push_back(head_.fact());
    result.safety_events = task_.safetyEvents();
    result.dropped = recorder_.dropped() + task_.lostTicks();
    result.simulated_s = static_cast<double>(executive_->clock().now()) * 1e-9;
    result.quit = task_.quit();
    return result;
  }

 private:
  task_needle::NeedleTask::Setup taskSetup() const {
    const bool person = options_.who == OperatorKind::person;
    return {world_.patient, world_.query, world_.task, world_.expert_path ? &*world_.expert_path : nullptr,
            world_.X_DA.inverse(), pack(world_.station.X_ET), isSimulated(options_, world_), !person,
            whyNotScored(options_, world_), plan(options_, world_, person), places()};
  }

  task_needle::SceneActivity::Setup sceneSetup() {
    task_needle::SceneActivity::Setup setup{stageSetup(), options_.skin_deflection ? &world_.query : nullptr, skinOf(world_.patient), {}};
    if (options_.guide) setup.guide = scene::Guide{world_.patient.landmark(anatomy::landmark::kEntry), world_.patient.landmark(anatomy::landmark::kVeinTarget)};
    return setup;
  }

  trial::TrialScene::Stage stageSetup() {
    using Views = trial::TrialScene::Views;
    trial::TrialScene::Stage setup;
    setup.views = !stage_.view ? Views::none : options_.fast ? Views::pictures : Views::continuous;
    setup.view = stage_.view.get();
    setup.head = head_.view.get();
    setup.camera = pictures_.camera();
    setup.X_WA = world_.X_WA;
    setup.X_WD = world_.station.X_WD;
    setup.mark = markFor(options_.who, world_.station);
    setup.folder = folder_;
    setup.every_source_picture = pictures_.photographs();
    setup.places = places();
    for (std::size_t i = 0; i < world_.real_things.size(); ++i) setup.things.push_back({&world_.real_things[i], &world_.station.things[i]});
    if (station::calibrationOf(world_.station.calibrations, "registration"))
      setup.tip_covariance_A = [this](const Pose& X_DT) { return tipCovariance(X_DT); };
    if (window_) {
      setup.input = [this](const scene::ViewInput& input, std::int64_t now_ns) {
        if (devices_.mouse() && head_.view && !head_.view->trouble().empty()) devices_.mouse()->letGo(now_ns);
        if (devices_.mouse()) devices_.mouse()->handle(input, now_ns);
        else handleKeys(input, channels_);
      };
    }
    return setup;
  }

  std::vector<runtime::BoardPlace> places() const {
    std::vector<runtime::BoardPlace> all;
    for (const station::OtherBoard& board : world_.station.boards) all.push_back({board.name, board.X_WB, board.tolerance});
    return all;
  }

  /// Of the drawn tip against the real one, in A.
  std::optional<Mat3> tipCovariance(const Pose& X_DT) const {
    const auto S_W = station::predictTipCovariance(world_.station, X_DT * world_.station.X_ET.inverse());
    const Mat3 R_AW = world_.X_WA.rotation().transpose();
    return S_W ? std::optional<Mat3>(R_AW * *S_W * R_AW.transpose()) : std::nullopt;
  }

  const SessionOptions& options_;
  NeedleWorld& world_;
  const std::filesystem::path folder_;
  const bool window_ = options_.display == scene::Display::window && !options_.no_views;
  SessionPictures pictures_{options_, world_.station};
  const Stage stage_ = options_.no_views ? Stage{} : makeStage(options_, world_.patient, window_);
  const HeadStage head_ = makeHeadStage(options_, world_, stage_);
  const std::unique_ptr<runtime::Executive> executive_ =
      options_.fast ? runtime::makeVirtualExecutive() : runtime::makeRealExecutive();
  const runtime::TimeMode mode_ = executive_->mode();
  runtime::Bus bus_{mode_};
  task_needle::TaskChannels channels_{mode_};
  SessionDevices devices_{options_, world_.station, needleHands(options_, world_), bus_, channels_, executive_->clock(), mode_};
  const haptics::TickConfig tick_ = tickConfig(options_, world_);
  runtime::GeometryActivity geometry_{bus_, world_.geometry, world_.X_DA};
  runtime::HapticActivity haptic_{bus_, devices_.device(), tick_, devices_.sensing(),
                                  options_.exact_geometry ? &geometry_ : nullptr};
  std::optional<runtime::VideoRecorder> video_;
  runtime::CameraActivity camera_{bus_,
                                  pictures_.exposer(devices_.bench(), executive_->clock()),
                                  pictures_.board(),
                                  pictures_.camera(),
                                  pictures_.settings(mode_),
                                  [this, look = pictures_.observer(devices_.bench())](const runtime::CameraView& view) {
                                    look(view);
                                    if (video_) video_->add(view);
                                  }};
  task_needle::NeedleTask task_{taskSetup(), bus_, channels_, *executive_};
  task_needle::SceneActivity scene_{sceneSetup(), bus_, channels_};
  record::SessionWriter writer_{folder_ / "session.palpa", sessionInfo(options_, world_, folder_)};
  runtime::RecorderActivity recorder_{bus_, writer_, tick_.period_ns};
  Progress progress_{options_.quiet};
  Interrupt interrupt_{channels_};
};

}  // namespace

SessionResult runNeedleSession(const SessionOptions& options, NeedleWorld& world,
                               const std::filesystem::path& folder) {
  return std::make_unique<NeedleSession>(options, world, folder)->run();
}

}  // namespace palpa::cli
