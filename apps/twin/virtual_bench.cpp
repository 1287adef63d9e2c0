#include "apps/twin/virtual_bench.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anatomy/base/quantile.h"
#include "anatomy/base/units.h"
#include "apps/runtime/clock.h"
#include "apps/twin/bench_faults.h"
#include "apps/twin/bench_truth.h"

namespace palpa::twin {
namespace {

constexpr std::int64_t kLongestHandStep_ns = 5'000'000;  // no movement is longer

}  // namespace

HeldTool::HeldTool(HeldToolSetup setup)
    : setup_(std::move(setup)),
      mechanics_(setup_.truth, setup_.X_DE_start),
      cell_noise_(setup_.seed, "bench.force_cells"),
      tracker_noise_(setup_.seed, "bench.tracker") {
  if (setup_.sensor) felt_.emplace(setup_.sensor_truth, setup_.seed);
}

/// What has passed while the hand waited, or while nothing on this computer moved, is no time for
/// it: a movement goes on where it was.
void HeldTool::passTime(bool waits, std::int64_t now_ns) {
  const std::int64_t step_ns = last_ns_ < 0 ? 0 : now_ns - last_ns_;
  last_ns_ = now_ns;
  missed_ns_ += waits ? step_ns : std::max<std::int64_t>(step_ns - kLongestHandStep_ns, 0);
}

const Hand::Action& HeldTool::act(const runtime::Displayed* seen, std::int64_t now_ns, double dt) {
  const bool waits = seen && now_ns - seen->t_ns > kOldPicture_ns;
  passTime(waits, now_ns);
  f_command_D_ = unpack(setup_.device->commanded(now_ns));
  f_hand_D_ = f_device_D_ = Vec3::Zero();
  if (waits) {
    action_.says = {};
    return action_;
  }
  Hand::Senses senses;
  senses.now_ns = now_ns - missed_ns_;
  senses.X_DE = mechanics_.truePose();
  senses.f_grip_D = mechanics_.gripForce();
  senses.f_fingers_D = mechanics_.fingerForce();
  senses.seen = seen;
  action_ = setup_.hand->act(senses, dt);
  return action_;
}

void HeldTool::advance(double dt, int parts) {
  mechanics_.advance(
      dt, action_.X_DH, setup_.hand->grip(), f_command_D_,
      setup_.X_WD.linear().transpose() * (touch_.f_W - setup_.truth.weight_N * Vec3::UnitZ()));
  f_hand_D_ += mechanics_.meanFingerForce() / parts;
  f_device_D_ += mechanics_.meanDeviceForce() / parts;
}

/// Two force cells, at the handle and before the tool, each with its own noise and as fine as a
/// converter is: whole binary parts of a newton also take little room in a record.
void HeldTool::measureForces(haptics::DeviceReading& reading) {
  constexpr double kNoise_N = 0.01, kCounts = 1024;  // [chosen] a good cell's; a newton
  const auto noisy = [&](const Vec3& f_D) {
    return pack(Vec3(
        ((f_D + kNoise_N * Vec3(cell_noise_.normal(), cell_noise_.normal(), cell_noise_.normal())) *
         kCounts)
            .array()
            .round() /
        kCounts));
  };
  reading.f_hand_D = noisy(f_hand_D_);
  reading.f_device_D = noisy(f_device_D_);
  reading.instrumented = 1;
}

void HeldTool::publishTracked(std::int64_t now_ns) {
  if (tracked_ns_ >= 0 && now_ns - tracked_ns_ < setup_.tracker->period_ns) return;
  tracked_ns_ = now_ns;
  RandomStream& noise = tracker_noise_;
  const Vec3 off = setup_.tracker->noise * Vec3(noise.normal(), noise.normal(), noise.normal());
  const Pose X_DE = mechanics_.truePose();
  haptics::DeviceReading reading;
  reading.t_ns = now_ns;
  reading.sequence = ++sequence_;
  reading.p_DE = pack(Vec3(X_DE.translation() + off));
  reading.q_DE = pack(Quat(X_DE.linear()));
  reading.homed = 1;
  setup_.device->publish(reading, now_ns);
}

void HeldTool::publish(std::int64_t now_ns, double dt) {
  if (setup_.tracker) return publishTracked(now_ns);
  haptics::DeviceReading reading;
  const PackedPose X_DE = mechanics_.encoderPose();
  reading.t_ns = now_ns;
  reading.sequence = ++sequence_;
  reading.p_DE = X_DE.p;
  reading.q_DE = X_DE.q;
  reading.plunger = action_.plunger;
  reading.buttons = action_.buttons;
  reading.homed = 1;
  measureForces(reading);
  setup_.device->publish(reading, now_ns);
  if (!felt_) return;
  haptics::WrenchSample sample = felt_->measure(setup_.X_WD * mechanics_.truePose() * setup_.X_ES,
                                                touch_.f_W, touch_.p_W, dt, now_ns);
  if (spoil(setup_.faults, 1e-9 * static_cast<double>(now_ns), setup_.zero, &sample))
    setup_.sensor->publish(sample, now_ns);
}

namespace {

constexpr std::int64_t kBenchPeriod = runtime::kMillisecond;
constexpr double kLongestBenchStep =
    1e-9 * kLongestHandStep_ns;  // s, a late step is not integrated over more

}  // namespace

struct VirtualBench::Impl final : public runtime::Activity {
  Impl(VirtualBenchSetup setup, runtime::Bus& bus_in, runtime::ChannelDevice& device_in)
      : bus(bus_in),
        X_WD_believed(setup.station.X_WD),
        X_ET_believed(setup.station.X_ET),
        watched_W(setup.watched_W),
        normal_W(setup.normal_W),
        station(setup.station),
        camera_faults(readCameraFaults(setup.station.file)),
        board_moves(readBoardMoves(setup.station)),
        sway(boomSway(setup.station)),
        X_CW_boom(cameraOnBoom(setup.station, setup.seed)),
        world_seed(setup.seed),
        real_thing(std::move(setup.real_thing)),
        on_word(std::move(setup.on_word)) {
    const WorldTruth world = drawWorld(setup.station, setup.seed);
    X_WD_true = world.X_WD;
    X_ET_true = world.X_ET;
    errors_mm.reserve(4096);
    tools.emplace_back(toolSetup(std::move(setup.hand), setup.X_DE_start, X_WD_true, device_in,
                                 setup.sensor, setup.seed));
    if (setup.second) {
      // As far off its place as the first one is: one table, one registration.
      const Pose X_WD2_true = X_WD_true * X_WD_believed.inverse() * setup.second->X_WD;
      tools.emplace_back(toolSetup(std::move(setup.second->hand), setup.second->X_DE_start,
                                   X_WD2_true, *setup.second->device, setup.second->sensor,
                                   setup.seed + 1, setup.second->tracker));
    }
  }

  void makeCamera() {
    VirtualCameraSettings settings;
    settings.latency_ns = static_cast<std::int64_t>(station.camera_latency_s * 1e9);
    VirtualScene scene;
    for (const station::OtherBoard& board : station.boards) scene.plates.push_back(board.grid);
    camera.emplace(trueCamera(station, world_seed), station.board, settings, world_seed, scene);
  }

  HeldToolSetup toolSetup(std::unique_ptr<Hand> hand, const Pose& X_DE_start, const Pose& X_WD,
                          runtime::ChannelDevice& device, runtime::ChannelSensor* sensor,
                          std::uint64_t seed,
                          const std::optional<FingerTracker>& tracker = {}) const {
    HeldToolSetup tool{.hand = std::move(hand),
                       .truth = trueDevice(station, seed),
                       .X_WD = X_WD,
                       .X_ET = X_ET_true,
                       .X_DE_start = X_DE_start,
                       .device = &device,
                       .sensor = sensor,
                       .faults = readSensorFaults(station.file),
                       .seed = seed,
                       .tracker = tracker};
    if (tracker) {  // what a finger carries: a light cap
      tool.truth.apparent_mass = 0.01;
      tool.truth.coulomb = tool.truth.viscous = tool.truth.weight_N = 0;
    }
    if (!sensor) return tool;
    tool.sensor_truth = trueSensor(station, seed);
    tool.X_ES = station.force_sensor->X_ES;
    tool.zero = station.force_sensor->bias;
    return tool;
  }

  const char* name() const override { return "bench"; }

  std::int64_t step(std::int64_t now_ns) override {
    const double dt = last_ns < 0 ? 1e-3
                                  : std::clamp(static_cast<double>(now_ns - last_ns) * 1e-9, 1e-4,
                                               kLongestBenchStep);
    last_ns = now_ns;
    const runtime::Displayed* seen = bus.scene_to_operator.read(now_ns);
    for (HeldTool& tool : tools) {
      const Hand::Action& action = tool.act(seen, now_ns, dt);
      if (action.says.kind != Hand::WordKind::none && on_word) on_word(action.says);
    }
    move(dt);
    for (HeldTool& tool : tools) tool.publish(now_ns, dt);
    due_ns = std::max((due_ns < 0 ? now_ns : due_ns) + kBenchPeriod, now_ns);
    return due_ns;
  }

  /// Hand, drives and mechanics; a real thing is touched more often than the loop ticks.
  void move(double dt) {
    constexpr int kTouches = 4;
    const int parts = real_thing ? kTouches : 1;
    for (int i = 0; i < parts; ++i) {
      for (HeldTool& tool : tools) tool.advance(dt / parts, parts);
      touchAll(dt / parts);
    }
  }

  /// Where nothing real lies its touch is none, at the tip.
  void touchAll(double dt) {
    std::array<Pose, 2> X_WT{tools.front().X_WT(), tools.back().X_WT()};
    const std::array<RealTouch, 2> touches =
        real_thing ? real_thing(X_WT, dt)
                   : std::array<RealTouch, 2>{{{Vec3::Zero(), X_WT[0].translation()},
                                               {Vec3::Zero(), X_WT[1].translation()}}};
    for (std::size_t t = 0; t < tools.size(); ++t) tools[t].touch(touches[t]);
  }

  Pose X_CW(std::int64_t t_ns) const { return swayed(X_CW_boom, sway, t_ns); }

  runtime::Bus& bus;
  Pose X_WD_believed, X_ET_believed, X_WD_true, X_ET_true;
  Vec3 watched_W, normal_W;
  const station::Station& station;
  std::vector<CameraFault> camera_faults;
  std::vector<BoardMove> board_moves;
  double sway;
  Pose X_CW_boom;
  std::uint64_t world_seed;
  TouchedObject real_thing;
  std::function<void(const Hand::Word&)> on_word;
  std::optional<VirtualCamera> camera;
  std::vector<HeldTool> tools;  // one or two
  std::int64_t last_ns = -1, due_ns = -1;
  std::size_t pictures = 0;
  std::vector<double> errors_mm;
};

VirtualBench::VirtualBench(VirtualBenchSetup setup, runtime::Bus& bus,
                           runtime::ChannelDevice& device)
    : impl_(std::make_unique<Impl>(std::move(setup), bus, device)) {}
VirtualBench::~VirtualBench() = default;

runtime::Activity& VirtualBench::activity() { return *impl_; }

runtime::CameraActivity::Exposer VirtualBench::exposer() {
  if (!impl_->camera) impl_->makeCamera();
  return [impl = impl_.get()](std::int64_t now_ns, std::uint64_t number) {
    const CameraFault* fault = faultAt(impl->camera_faults, 1e-9 * static_cast<double>(now_ns));
    const bool frozen = fault && fault->kind == CameraFaultKind::frozen;
    const std::int64_t seen_ns = frozen ? std::llround(1e9 * fault->from) : now_ns;
    const Pose X_CW = impl->X_CW(seen_ns);
    std::vector<PlatePose> plates;
    for (const auto& [i, X_WB] :
         boardsAt(impl->station, impl->board_moves, 1e-9 * static_cast<double>(seen_ns)))
      plates.push_back({i, X_CW * X_WB});
    return [impl, X_CW, plates, now_ns, number, fault,
            frozen](const cv::Rect& part) -> std::optional<ar::Frame> {
      const std::uint64_t seen = frozen ? 0 : number;
      ar::Frame frame{number, now_ns,
                      plates.empty() ? impl->camera->render(X_CW, seen, part)
                                     : impl->camera->render(X_CW, plates, seen),
                      "virtual camera"};
      return fault ? spoilt(std::move(frame), *fault) : std::optional(std::move(frame));
    };
  };
}

runtime::CameraActivity::Finder VirtualBench::finder(const TrackingFigures& figures) const {
  const auto model = std::make_shared<const TrackingModel>(
      figures, trueCamera(impl_->station, impl_->world_seed), impl_->world_seed);
  return [impl = impl_.get(), model](std::int64_t now_ns, std::uint64_t number) {
    return model->found(impl->X_CW(now_ns), number);
  };
}

void VirtualBench::observe(const runtime::CameraView& view) {
  ++impl_->pictures;
  if (!view.X_CW) return;
  const Vec3 drawn_C = *view.X_CW * impl_->watched_W;
  const Vec3 true_C = impl_->X_CW(view.t_exposure_ns) * impl_->watched_W;
  impl_->errors_mm.push_back((drawn_C - true_C).norm() / kMm);
}

BenchAccuracy VirtualBench::accuracy() const {
  BenchAccuracy a;
  a.pictures = impl_->pictures;
  a.registered = impl_->errors_mm.size();
  a.entry_median_mm = quantile(impl_->errors_mm, 0.5);
  a.entry_p95_mm = quantile(impl_->errors_mm, 0.95);
  a.distance_m = impl_->X_CW_boom.translation().norm();
  // The reading that puts the believed tip on the entry point, needle along the skin's normal.
  const Pose X_WT = makePose(rotationWithZ(-impl_->normal_W), impl_->watched_W);
  const Pose X_DE = impl_->X_WD_believed.inverse() * X_WT * impl_->X_ET_believed.inverse();
  const Vec3 true_tip_W = (impl_->X_WD_true * X_DE * impl_->X_ET_true).translation();
  a.tool_mm = (true_tip_W - impl_->watched_W).norm() / kMm;
  return a;
}

}  // namespace palpa::twin
