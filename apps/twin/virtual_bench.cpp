#include "apps/twin/virtual_bench.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "apps/runtime/clock.h"
#include "apps/runtime/quantile.h"
#include "apps/twin/bench_truth.h"
#include "apps/twin/board_moves.h"
#include "apps/twin/camera_faults.h"
#include "apps/twin/sensor_faults.h"
#include "apps/twin/sensor_twin.h"

namespace palpa::twin {
namespace {

constexpr double kMm = 1e-3;
constexpr std::int64_t kBenchPeriod = runtime::kMillisecond;
constexpr double kLongestBenchStep = 0.005;  // s, a late step is not integrated over more

}  // namespace

struct VirtualBench::Impl final : public runtime::Activity {
  Impl(Setup setup, runtime::Bus& bus_in, runtime::ChannelDevice& device_in)
      : bus(bus_in),
        device(device_in),
        X_WD_believed(setup.station.X_WD),
        X_ET_believed(setup.station.X_ET),
        watched_W(setup.watched_W),
        normal_W(setup.normal_W),
        station(setup.station),
        camera_faults(readCameraFaults(setup.station.file)),
        sensor_faults(readSensorFaults(setup.station.file)),
        board_moves(readBoardMoves(setup.station)),
        sway(kMm * setup.station.file.number("twin/camera_sway_mm", 0, 100)),
        X_CW_boom(cameraOnBoom(setup.station, setup.seed)),
        cell_noise(setup.seed, "bench.force_cells"),
        mechanics(trueDevice(setup.station, setup.seed), setup.X_DE_start),
        hand(std::move(setup.hand)),
        real_thing(std::move(setup.real_thing)) {
    X_WD_true = drawWorld(setup.station, setup.seed).X_WD;
    X_ET_true = drawWorld(setup.station, setup.seed).X_ET;
    VirtualCameraSettings settings;
    settings.latency_ns = static_cast<std::int64_t>(setup.station.camera_latency_s * 1e9);
    VirtualScene scene;
    for (const station::OtherBoard& board : setup.station.boards) scene.plates.push_back(board.grid);
    camera.emplace(trueCamera(setup.station, setup.seed), setup.station.board, settings, setup.seed, scene);
    errors_mm.reserve(4096);
    on_word = setup.on_word;
    sensor = setup.sensor;
    if (sensor) {
      X_ES = setup.station.force_sensor->X_ES;
      felt.emplace(trueSensor(setup.station, setup.seed), setup.seed);
    }
  }

  const char* name() const override { return "bench"; }

  std::int64_t step(std::int64_t now_ns) override {
    const double dt =
        last_ns < 0 ? 1e-3 : std::clamp(static_cast<double>(now_ns - last_ns) * 1e-9, 1e-4, kLongestBenchStep);
    last_ns = now_ns;
    Hand::Senses senses;
    senses.now_ns = now_ns;
    senses.X_DE = mechanics.truePose();
    senses.f_grip_D = mechanics.gripForce();
    senses.f_fingers_D = mechanics.fingerForce();
    senses.seen = bus.scene_to_operator.read(now_ns);
    const Hand::Action action = hand->act(senses, dt);
    if (action.says.kind != Hand::Word::Kind::none && on_word) on_word(action.says);
    move(action, unpack(device.commanded(now_ns)), dt);
    haptics::DeviceReading reading;
    const PackedPose X_DE = mechanics.encoderPose();
    reading.t_ns = now_ns;
    reading.sequence = ++sequence;
    reading.p_DE = X_DE.p;
    reading.q_DE = X_DE.q;
    reading.plunger = action.plunger;
    reading.buttons = action.buttons;
    reading.homed = 1;
    measureForces(reading);
    device.publish(reading, now_ns);
    if (sensor) {
      const Pose X_WE = X_WD_true * mechanics.truePose();
      if (!real_thing) touch.p_W = (X_WE * X_ET_true).translation();
      haptics::WrenchSample sample = felt->measure(X_WE * X_ES, touch.f_W, touch.p_W, dt, now_ns);
      if (spoil(sensor_faults, 1e-9 * static_cast<double>(now_ns), station.force_sensor->filter.bias, &sample)) sensor->publish(sample, now_ns);
    }
    due_ns = std::max((due_ns < 0 ? now_ns : due_ns) + kBenchPeriod, now_ns);
    return due_ns;
  }

  /// Two force cells, at the handle and before the tool, each with its own noise and as fine as a converter is: whole binary parts of a newton also take little room in a record.
  void measureForces(haptics::DeviceReading& reading) {
    constexpr double kNoise_N = 0.01, kCounts = 1024;   // [chosen] a good cell's; a newton
    const auto noisy = [&](const Vec3& f_D) { return pack(Vec3(((f_D + kNoise_N * Vec3(cell_noise.normal(), cell_noise.normal(), cell_noise.normal())) * kCounts).array().round() / kCounts)); };
    reading.f_hand_D = noisy(f_hand_D);
    reading.f_device_D = noisy(f_device_D);
    reading.instrumented = 1;
  }

  /// Hand, drives and mechanics; a real thing is touched more often than the loop ticks.
  void move(const Hand::Action& action, const Vec3& f_command_D, double dt) {
    constexpr int kTouches = 4;
    const int parts = real_thing ? kTouches : 1;
    f_hand_D = f_device_D = Vec3::Zero();
    for (int i = 0; i < parts; ++i) {
      mechanics.advance(dt / parts, action.X_DH, hand->grip(), f_command_D, X_WD_true.linear().transpose() * touch.f_W);
      f_hand_D += mechanics.meanFingerForce() / parts;
      f_device_D += mechanics.meanDeviceForce() / parts;
      if (real_thing) touch = real_thing(X_WD_true * mechanics.truePose() * X_ET_true, dt / parts);
    }
  }

  /// The boom sways a little: two slow sines.
  Pose X_CW(std::int64_t t_ns) const {
    const double t = static_cast<double>(t_ns) * 1e-9;
    Pose X = X_CW_boom;
    X.translation() += sway * Vec3(std::sin(2 * std::numbers::pi * 0.23 * t),
                                   std::sin(2 * std::numbers::pi * 0.17 * t + 1), 0);
    return X;
  }

  runtime::Bus& bus;
  runtime::ChannelDevice& device;
  Pose X_WD_believed, X_ET_believed, X_WD_true, X_ET_true;
  Vec3 watched_W, normal_W;
  Touch touch;
  Vec3 f_hand_D = Vec3::Zero(), f_device_D = Vec3::Zero();   // means over the last step
  const station::Station& station;
  std::vector<CameraFault> camera_faults;
  std::vector<SensorFault> sensor_faults;
  std::vector<BoardMove> board_moves;
  double sway;
  Pose X_CW_boom;
  runtime::RandomStream cell_noise;
  DeviceTwin mechanics;
  std::unique_ptr<Hand> hand;
  RealThing real_thing;
  std::optional<VirtualCamera> camera;
  runtime::ChannelSensor* sensor = nullptr;
  std::optional<SensorTwin> felt;
  Pose X_ES = Pose::Identity();
  std::function<void(const Hand::Word&)> on_word;
  std::uint64_t sequence = 0;
  std::int64_t last_ns = -1, due_ns = -1;
  std::size_t pictures = 0;
  std::vector<double> errors_mm;
};

VirtualBench::VirtualBench(Setup setup, runtime::Bus& bus, runtime::ChannelDevice& device)
    : impl_(std::make_unique<Impl>(std::move(setup), bus, device)) {}
VirtualBench::~VirtualBench() = default;

runtime::Activity& VirtualBench::activity() { return *impl_; }

runtime::CameraActivity::Exposer VirtualBench::exposer() const {
  return [impl = impl_.get()](std::int64_t now_ns, std::uint64_t number) {
    const CameraFault* fault = faultAt(impl->camera_faults, 1e-9 * static_cast<double>(now_ns));
    const bool frozen = fault && fault->kind == CameraFault::Kind::frozen;
    const std::int64_t seen_ns = frozen ? std::llround(1e9 * fault->from) : now_ns;
    const Pose X_CW = impl->X_CW(seen_ns);
    std::vector<PlatePose> plates;
    for (const auto& [i, X_WB] : boardsAt(impl->station, impl->board_moves, 1e-9 * static_cast<double>(seen_ns))) plates.push_back({i, X_CW * X_WB});
    return [impl, X_CW, plates, now_ns, number, fault, frozen]() -> std::optional<ar::Frame> {
      ar::Frame frame{number, now_ns, impl->camera->render(X_CW, plates, frozen ? 0 : number), "virtual camera"};
      return fault ? spoilt(std::move(frame), *fault) : std::optional(std::move(frame));
    };
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
  a.entry_median_mm = runtime::quantile(impl_->errors_mm, 0.5);
  a.entry_p95_mm = runtime::quantile(impl_->errors_mm, 0.95);
  a.distance_m = impl_->X_CW_boom.translation().norm();
  // The reading that puts the believed tip on the entry point, needle along the skin's normal.
  const Pose X_WT = makePose(rotationWithZ(-impl_->normal_W), impl_->watched_W);
  const Pose X_DE = impl_->X_WD_believed.inverse() * X_WT * impl_->X_ET_believed.inverse();
  const Vec3 true_tip_W = (impl_->X_WD_true * X_DE * impl_->X_ET_true).translation();
  a.tool_mm = (true_tip_W - impl_->watched_W).norm() / kMm;
  return a;
}

}  // namespace palpa::twin
