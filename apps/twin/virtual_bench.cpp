#include "apps/twin/virtual_bench.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "apps/runtime/clock.h"
#include "apps/runtime/quantile.h"
#include "apps/runtime/random.h"
#include "apps/twin/sensor_twin.h"

namespace palpa::twin {
namespace {

using runtime::RandomStream;
constexpr double kMm = 1e-3;
constexpr double kDeg = std::numbers::pi / 180;
constexpr std::int64_t kBenchPeriod = runtime::kMillisecond;
constexpr double kLongestBenchStep = 0.005;  // s, a late step is not integrated over more

Vec3 normal3(RandomStream& random) { return {random.normal(), random.normal(), random.normal()}; }

Pose perturbed(const Pose& X, double sd_m, double sd_rad, RandomStream& random) {
  const Vec3 turn = sd_rad * normal3(random);
  const double angle = turn.norm();
  Pose nudge = Pose::Identity();
  if (angle > 0) nudge.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  nudge.translation() = sd_m * normal3(random);
  return X * nudge;
}

calibration::CameraModel trueCamera(const station::Station& station, std::uint64_t seed) {
  RandomStream random(seed, "bench.camera");
  const station::JsonFile& file = station.file;
  const double focal = 0.01 * file.number("twin/focal_spread_percent", 0, 10);
  const double centre = file.number("twin/centre_spread_px", 0, 50);
  const double bend = 0.01 * file.number("twin/distortion_spread_percent", 0, 50);
  calibration::CameraModel truth = station.camera;
  truth.fx *= 1 + focal * random.normal();
  truth.fy *= 1 + focal * random.normal();
  truth.cx += centre * random.normal();
  truth.cy += centre * random.normal();
  for (double& k : truth.distortion) k *= 1 + bend * random.normal();
  return truth;
}

DeviceTruth trueDevice(const station::Station& station) {
  const station::JsonFile& file = station.file;
  DeviceTruth truth;
  truth.apparent_mass = station.device.capabilities.apparent_mass;
  truth.max_force_N = station.device.capabilities.max_force_N;
  truth.coulomb = file.number("twin/device/coulomb_N", 0, 10);
  truth.viscous = file.number("twin/device/viscous_Ns_per_m", 0, 100);
  truth.encoder_step = kMm * file.number("twin/device/encoder_step_mm", 1e-6, 1);
  truth.encoder_angle = kDeg * file.number("twin/device/encoder_angle_deg", 1e-6, 5);
  truth.actuator_tau = 1e-3 * file.number("twin/device/actuator_tau_ms", 0, 100);
  return truth;
}

SensorTruth trueSensor(const station::Station& station, std::uint64_t seed) {
  RandomStream random(seed, "bench.force_sensor.truth");
  const station::JsonFile& file = station.file;
  const station::ForceSensorSetup& believed = *station.force_sensor;
  SensorTruth truth;
  const double mass = 0.01 * file.number("twin/force_sensor/tool_mass_spread_percent", 0, 50);
  const double centre = kMm * file.number("twin/force_sensor/centre_spread_mm", 0, 50);
  const double bias = file.number("twin/force_sensor/bias_spread_N", 0, 5);
  const double bias_Nm = file.number("twin/force_sensor/bias_spread_Nm", 0, 1);
  truth.tool_mass = believed.filter.tool.mass * (1 + mass * random.normal());
  truth.p_SM = pack(Vec3(unpack(believed.filter.tool.p_SM) + centre * normal3(random)));
  truth.bias_N = pack(Vec3(unpack(believed.filter.bias.f_S) + bias * normal3(random)));
  truth.bias_Nm = pack(Vec3(unpack(believed.filter.bias.tau_S) + bias_Nm * normal3(random)));
  truth.noise_N = file.number("twin/force_sensor/noise_N", 0, 1);
  truth.noise_Nm = file.number("twin/force_sensor/noise_Nm", 0, 1);
  truth.max_force_N = believed.net_ft.capabilities.max_force_N;
  return truth;
}

/// A camera on a boom on the trainee's side, looking between board and patient.
Pose cameraOnBoom(const station::Station& station, std::uint64_t seed) {
  RandomStream random(seed, "bench.boom");
  const double distance = kMm * (station.file.number("twin/camera_distance_mm", 100, 3000) +
                                 station.file.number("twin/camera_distance_spread_mm", 0, 500) *
                                     random.normal());
  const Vec3 p_WC = distance * Vec3(0.04 * random.normal(), -0.48, 0.877).normalized();
  const Vec3 forward = (Vec3(0, 0.125, 0.02) - p_WC).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized();
  Mat3 R_WC;
  R_WC << right, forward.cross(right), forward;
  return makePose(R_WC, p_WC).inverse();
}

/// The needle above the entry, pointing down and a little ahead: where a trainee picks it up.
Pose restPose(const station::Station& station, const Pose& X_WA, const Vec3& entry_A,
              bool left_handed) {
  const Vec3 tip_W = X_WA * entry_A + Vec3(left_handed ? -0.02 : 0.02, -0.05, 0.07);
  const Vec3 axis_W = Vec3(0, 0.35, -1).normalized();
  return station.X_WD.inverse() * makePose(rotationWithZ(axis_W), tip_W) * station.X_ET.inverse();
}

}  // namespace

struct VirtualBench::Impl final : public runtime::Activity {
  Impl(const Setup& setup, runtime::Bus& bus_in, runtime::ChannelDevice& device_in)
      : bus(bus_in),
        device(device_in),
        X_WD_believed(setup.station.X_WD),
        X_ET_believed(setup.station.X_ET),
        entry_W(setup.X_WA * setup.anatomy.entry_A),
        normal_W(setup.X_WA.rotation() * setup.anatomy.normal_A),
        sway(kMm * setup.station.file.number("twin/camera_sway_mm", 0, 100)),
        X_CW_boom(cameraOnBoom(setup.station, setup.seed)),
        mechanics(trueDevice(setup.station), restPose(setup.station, setup.X_WA, setup.anatomy.entry_A,
                           setup.left_handed)),
        hand(setup.skill, setup.anatomy, setup.station.X_ET, setup.seed) {
    RandomStream random(setup.seed, "bench.registration");
    const station::JsonFile& file = setup.station.file;
    X_WD_true = perturbed(X_WD_believed, kMm * file.number("twin/registration_spread_mm", 0, 50),
                          kDeg * file.number("twin/registration_spread_deg", 0, 10), random);
    X_ET_true = perturbed(X_ET_believed, kMm * file.number("twin/tool_spread_mm", 0, 50), 0, random);
    VirtualCameraSettings settings;
    settings.latency_ns = static_cast<std::int64_t>(setup.station.camera_latency_s * 1e9);
    camera.emplace(trueCamera(setup.station, setup.seed), setup.station.board, settings, setup.seed);
    errors_mm.reserve(4096);
    on_giving_up = setup.on_giving_up;
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
    Operator::Senses senses;
    senses.now_ns = now_ns;
    senses.X_DE = mechanics.truePose();
    senses.f_grip_D = mechanics.gripForce();
    senses.seen = bus.scene_to_operator.read(now_ns);
    const Operator::Action action = hand.act(senses, dt);
    if (action.gives_up && on_giving_up) on_giving_up();
    mechanics.advance(dt, action.X_DH, hand.grip(), unpack(device.commanded(now_ns)));
    haptics::DeviceReading reading;
    const PackedPose X_DE = mechanics.encoderPose();
    reading.t_ns = now_ns;
    reading.sequence = ++sequence;
    reading.p_DE = X_DE.p;
    reading.q_DE = X_DE.q;
    reading.plunger = action.plunger;
    reading.homed = 1;
    device.publish(reading, now_ns);
    if (sensor) {  // nothing real is touched on the bench: its patient is virtual
      const Pose X_WS = X_WD_true * mechanics.truePose() * X_ES;
      sensor->publish(felt->measure(X_WS, Vec3::Zero(), X_WS.translation(), dt, now_ns), now_ns);
    }
    due_ns = std::max((due_ns < 0 ? now_ns : due_ns) + kBenchPeriod, now_ns);
    return due_ns;
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
  Vec3 entry_W, normal_W;
  double sway;
  Pose X_CW_boom;
  DeviceTwin mechanics;
  Operator hand;
  std::optional<VirtualCamera> camera;
  runtime::ChannelSensor* sensor = nullptr;
  std::optional<SensorTwin> felt;
  Pose X_ES = Pose::Identity();
  std::function<void()> on_giving_up;
  std::uint64_t sequence = 0;
  std::int64_t last_ns = -1, due_ns = -1;
  std::size_t pictures = 0;
  std::vector<double> errors_mm;
};

VirtualBench::VirtualBench(const Setup& setup, runtime::Bus& bus, runtime::ChannelDevice& device)
    : impl_(std::make_unique<Impl>(setup, bus, device)) {}
VirtualBench::~VirtualBench() = default;

runtime::Activity& VirtualBench::activity() { return *impl_; }

runtime::CameraActivity::Exposer VirtualBench::exposer() const {
  return [impl = impl_.get()](std::int64_t now_ns, std::uint64_t number) {
    const Pose X_CW = impl->X_CW(now_ns);
    return [impl, X_CW, now_ns, number]() -> std::optional<ar::Frame> {
      return ar::Frame{number, now_ns, impl->camera->render(X_CW, number), "virtual camera"};
    };
  };
}

void VirtualBench::observe(const runtime::CameraView& view) {
  ++impl_->pictures;
  if (!view.pose) return;
  const Vec3 drawn_C = view.pose->X_CW * impl_->entry_W;
  const Vec3 true_C = impl_->X_CW(view.t_exposure_ns) * impl_->entry_W;
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
  const Pose X_WT = makePose(rotationWithZ(-impl_->normal_W), impl_->entry_W);
  const Pose X_DE = impl_->X_WD_believed.inverse() * X_WT * impl_->X_ET_believed.inverse();
  const Vec3 true_tip_W = (impl_->X_WD_true * X_DE * impl_->X_ET_true).translation();
  a.tool_mm = (true_tip_W - impl_->entry_W).norm() / kMm;
  return a;
}

}  // namespace palpa::twin
