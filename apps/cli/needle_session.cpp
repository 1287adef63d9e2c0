#include "apps/cli/needle_session.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"
#include "anatomy/patient_file.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/progress.h"
#include "apps/cli/session_devices.h"
#include "apps/cli/stage.h"
#include "apps/record/session_file.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"
#include "apps/runtime/recorder_activity.h"
#include "apps/station/assets.h"
#include "ar/image_sequence.h"

namespace palpa::cli {
namespace {

constexpr std::uint64_t kFamiliarisationSeed = 1'000'000;  // another skin than the scored trials

std::string bytesOf(const anatomy::Patient& patient, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".patient.glb";
  anatomy::writePatient(patient, file);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::filesystem::remove(file);
  return bytes;
}

nlohmann::json json(const Pose& X) {
  const PackedPose p = pack(X);
  return {{"p_m", p.p}, {"q_wxyz", p.q}};
}

haptics::TickConfig tickConfig(const SessionOptions& options, const NeedleWorld& world) {
  haptics::TickConfig config = world.tickConfig();
  config.period_ns = std::llround(1e9 / options.rate_Hz);
  if (options.exact_geometry) config.blend_ns = 0;  // every tick has its own
  const station::DeviceSetup& device = world.station.device;
  const bool has_buttons = !isSimulated(options.who) && device.driver != station::DeviceDriver::mouse;
  if (!has_buttons) config.safety.deadman_button = 0;  // nobody could hold it
  config.device_turns = isSimulated(options.who) || device.capabilities.has_orientation;
  return config;
}

record::SessionInfo sessionInfo(const SessionOptions& options, const NeedleWorld& world,
                                const std::string& who, bool simulated,
                                const std::filesystem::path& folder) {
  record::SessionInfo info;
  info.started_utc = utcNow();
  info.software = std::string("palpa ") + PALPA_VERSION;
  info.command = options.command;
  info.session_json = nlohmann::json{{"seed", options.seed},
                                     {"operator", who},
                                     {"simulated", simulated},
                                     {"trainee", options.trainee},
                                     {"force_feedback", options.force_feedback},
                                     {"side", anatomy::name(world.patient.side)},
                                     {"handedness", options.left_handed ? "left" : "right"},
                                     {"virtual_time", options.fast},
                                     {"X_DA", json(world.X_DA)},
                                     {"X_WA", json(world.X_WA)},
                                     {"X_WD", json(world.station.X_WD)}}
                          .dump();
  info.station_json = world.station.file.json().dump();
  info.task_json = world.task.source;
  info.patient_glb = bytesOf(world.patient, folder);
  if (world.expert_path) {
    std::ifstream stream(world.task.expert_path);
    info.expert_path_json.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  info.tick_config = tickConfig(options, world);
  return info;
}

/// Empty: trials count.
std::string whyNotScored(const NeedleWorld& world) {
  if (world.station.calibration_verdict != "pass") return world.station.calibration_verdict;
  if (!world.station.device.capabilities.has_orientation)
    return "the device does not measure how the needle is held";
  return "";
}

std::vector<task_needle::TrialPlan> plan(const SessionOptions& options, const NeedleWorld& world,
                                         bool person) {
  const bool scored = whyNotScored(world).empty();
  std::vector<task_needle::TrialPlan> trials;
  if (person && options.familiarisation)
    trials.push_back(world.trial("familiarisation", options.seed + kFamiliarisationSeed, options.force_feedback));
  for (int i = 0; i < options.trials; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    trials.push_back(world.trial(scored ? options.role : "not scored", seed, options.force_feedback));
  }
  return trials;
}

/// Recorded pictures as the camera: one after the other, over and over.
class PictureLoop {
 public:
  PictureLoop(const std::string& glob, double fps) : glob_(glob), fps_(fps), source_(glob, fps) {}
  std::size_t count() const { return source_.files().size(); }
  std::optional<ar::Frame> next() {
    std::optional<ar::Frame> frame = source_.grab();
    if (!frame) {
      source_ = ar::ImageSequence(glob_, fps_);
      frame = source_.grab();
    }
    return frame;
  }

 private:
  std::string glob_;
  double fps_;
  ar::ImageSequence source_;
};

calibration::CameraModel checkedCamera(const NeedleWorld& world, PictureLoop* pictures) {
  const calibration::CameraModel& camera = world.station.camera;
  if (!pictures) return camera;
  const std::optional<ar::Frame> first = pictures->next();
  if (first && (first->image.cols != camera.width || first->image.rows != camera.height))
    throw UsageError("is " + std::to_string(first->image.cols) + "x" + std::to_string(first->image.rows) +
                         ", but the intrinsics are for " + std::to_string(camera.width) + "x" +
                         std::to_string(camera.height),
                     first->source, "Give the --intrinsics of this camera");
  return camera;
}

std::string nameOf(OperatorKind who) {
  switch (who) {
    case OperatorKind::person: return "person";
    case OperatorKind::recorded: return "recorded";
    case OperatorKind::novice: return "novice";
    default: return "expert";
  }
}

std::string markFor(OperatorKind who, const station::Station& station) {
  if (isSimulated(who)) return "SIMULATED OPERATOR";
  if (who == OperatorKind::recorded) return "RECORDED HAND";
  if (!station.simulated) return "";
  return station.device.driver == station::DeviceDriver::bench ? "VIRTUAL BENCH" : "VIRTUAL CAMERA";
}

}  // namespace

SessionResult runNeedleSession(const SessionOptions& options, NeedleWorld& world,
                               const std::filesystem::path& folder) {
  const bool person = options.who == OperatorKind::person;
  const bool window = options.display == scene::Display::window && !options.no_views;
  const std::string who = nameOf(options.who);
  const bool simulated = isSimulated(options.who) || world.station.simulated;
  std::unique_ptr<PictureLoop> recorded;
  if (!options.camera.empty()) recorded = std::make_unique<PictureLoop>(options.camera, world.station.camera_rate_Hz);
  const calibration::CameraModel camera = checkedCamera(world, recorded.get());
  if (recorded) recorded = std::make_unique<PictureLoop>(options.camera, world.station.camera_rate_Hz);
  std::unique_ptr<ar::Board> board;
  if (options.board.empty()) {
    board = ar::makeBoard(world.station.board, world.station.decimate);
  } else {
    board = ar::makeBoard(options.board, recorded ? 1.0 : world.station.decimate);
  }

  const Stage stage = options.no_views ? Stage{} : makeStage(options, world, window);

  const auto executive = options.fast ? runtime::makeVirtualExecutive() : runtime::makeRealExecutive();
  const runtime::TimeMode mode = executive->mode();
  runtime::Bus bus(mode);
  task_needle::TaskChannels channels(mode);
  SessionDevices devices(options, world, bus, channels, executive->clock(), mode);

  SessionResult result;
  runtime::CameraActivity::Exposer expose;
  if (recorded) {
    expose = [&](std::int64_t now_ns, std::uint64_t number) {
      return [&, now_ns, number]() {
        auto frame = recorded->next();
        if (frame) frame->t_exposure_ns = now_ns, frame->number = number;
        return frame;
      };
    };
  } else {
    expose = devices.bench().exposer();
  }
  const auto observe = [&](const runtime::CameraView& view) {
    if (!recorded) return devices.bench().observe(view);
    if (result.registration.size() >= recorded->count() || view.ended) return;
    RegistrationRow row{view.source, 0, 0, Pose::Identity()};
    if (view.pose) row = {view.source, view.pose->points, view.pose->rms_px, view.pose->X_CW};
    result.registration.push_back(row);
  };
  runtime::CameraActivity::Settings camera_settings;
  camera_settings.period_ns = static_cast<std::int64_t>(1e9 / world.station.camera_rate_Hz);
  camera_settings.latency_ns = static_cast<std::int64_t>(1e9 * world.station.camera_latency_s);
  camera_settings.mode = mode;
  runtime::CameraActivity camera_activity(bus, expose, *board, camera, camera_settings, observe);

  const haptics::TickConfig tick = tickConfig(options, world);
  runtime::GeometryActivity geometry(bus, world.geometry, world.X_DA);
  runtime::HapticActivity haptic(bus, devices.device(), tick, devices.sensing(),
                                 options.exact_geometry ? &geometry : nullptr);
  task_needle::NeedleTask::Setup task_setup{
      world.patient, world.query, world.task,
      world.expert_path ? &*world.expert_path : nullptr,
      world.X_DA.inverse(), pack(world.station.X_ET), simulated, !person, whyNotScored(world),
      plan(options, world, person)};
  task_needle::NeedleTask task(task_setup, bus, channels, *executive);

  task_needle::SceneActivity::Setup scene_setup;
  using Views = task_needle::SceneActivity::Views;
  scene_setup.views = !stage.view ? Views::none : options.fast ? Views::pictures : Views::continuous;
  scene_setup.view = stage.view.get();
  scene_setup.camera = camera;
  scene_setup.X_WA = world.X_WA;
  scene_setup.X_WD = world.station.X_WD;
  scene_setup.mark = markFor(options.who, world.station);
  scene_setup.folder = folder;
  scene_setup.every_source_picture = static_cast<bool>(recorded);
  if (window) {
    scene_setup.input = [&](const scene::ViewInput& input, std::int64_t now_ns) {
      if (devices.mouse()) devices.mouse()->handle(input, now_ns);
      else handleKeys(input, channels);
    };
  }
  task_needle::SceneActivity scene(scene_setup, bus, channels);
  if (devices.mouse()) devices.mouse()->onSkinKey([&] { scene.cycleSkin(); });

  // The evidence file is opened last: a mistake in the set-up leaves none behind.
  record::SessionWriter writer(folder / "session.palpa", sessionInfo(options, world, who, simulated, folder));
  runtime::RecorderActivity recorder(bus, writer, tick.period_ns);
  Progress progress(options.quiet);
  Interrupt interrupt(channels);
  devices.addTo(*executive);
  executive->add(haptic, {1, true, false, options.cpu});
  if (!options.exact_geometry) executive->add(geometry, {2, false, false});
  executive->add(camera_activity, {3, false, false});
  executive->add(task, {4, false, false});
  executive->add(scene, {5, false, true});
  executive->add(recorder, {6, false, false});
  executive->add(progress, {7, false, false});
  executive->add(interrupt, {8, false, false});
  executive->run();

  scene.finish(executive->clock().now());
  recorder.finish();
  writer.close();
  result.trials = task.completed();
  result.pictures = scene.pictures();
  result.lateness = executive->lateness();
  if (!recorded) result.accuracy = devices.bench().accuracy();
  result.devices = devices.facts();
  result.safety_events = task.safetyEvents();
  result.dropped = recorder.dropped() + task.lostTicks();
  result.simulated_s = static_cast<double>(executive->clock().now()) * 1e-9;
  result.quit = task.quit();
  return result;
}

}  // namespace palpa::cli
