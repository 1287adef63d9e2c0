#include "apps/twin/bench_truth.h"

#include <algorithm>
#include <numbers>

#include "anatomy/base/units.h"
#include "anatomy/geometry/random_vector.h"

namespace palpa::twin {
namespace {

Pose perturbed(const Pose& X, double sd_m, double sd_rad, RandomStream& random) {
  const Vec3 turn = sd_rad * normal3(random);
  const double angle = turn.norm();
  Pose nudge = Pose::Identity();
  if (angle > 0) nudge.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  nudge.translation() = sd_m * normal3(random);
  return X * nudge;
}

/// A spread that a station need not state.
double spreadOr0(const JsonFile& file, const std::string& at, double most) {
  return file.has(at) ? file.number(at, 0, most) : 0;
}

}  // namespace

WorldTruth drawWorld(const station::Station& station, std::uint64_t seed) {
  const JsonFile& file = station.file;
  RandomStream random(seed, "bench.registration"), clocks(seed, "bench.clocks"),
      needle(seed, "bench.needle");
  WorldTruth truth;
  truth.X_WD =
      perturbed(station.design.X_WD, kMm * file.number("twin/registration_spread_mm", 0, 50),
                kDegree * file.number("twin/registration_spread_deg", 0, 10), random);
  truth.X_ET =
      perturbed(station.design.X_ET, kMm * file.number("twin/tool_spread_mm", 0, 50), 0, random);
  truth.X_ET =
      perturbed(truth.X_ET, 0, kDegree * spreadOr0(file, "twin/tool_spread_deg", 10), needle);
  const double latency = 1e-3 * spreadOr0(file, "twin/camera_latency_spread_ms", 50);
  truth.camera_latency_s =
      std::max(station.design.camera_latency_s + latency * clocks.normal(), 0.001);
  truth.clock_drift = 1e-6 * spreadOr0(file, "twin/clock_drift_ppm", 1000) * clocks.normal();
  return truth;
}

calibration::CameraModel trueCamera(const station::Station& station, std::uint64_t seed) {
  RandomStream random(seed, "bench.camera");
  const JsonFile& file = station.file;
  const double focal = 0.01 * file.number("twin/focal_spread_percent", 0, 10);
  const double centre = file.number("twin/centre_spread_px", 0, 50);
  const double bend = 0.01 * file.number("twin/distortion_spread_percent", 0, 50);
  calibration::CameraModel truth = station.design.camera;
  truth.fx *= 1 + focal * random.normal();
  truth.fy *= 1 + focal * random.normal();
  truth.cx += centre * random.normal();
  truth.cy += centre * random.normal();
  for (double& k : truth.distortion) k *= 1 + bend * random.normal();
  return truth;
}

DeviceTruth trueDevice(const station::Station& station, std::uint64_t seed) {
  const JsonFile& file = station.file;
  DeviceTruth truth;
  truth.apparent_mass = station.device.capabilities.apparent_mass;
  truth.max_force_N = station.device.capabilities.max_force_N;
  truth.coulomb = file.number("twin/device/coulomb_N", 0, 10);
  truth.viscous = file.number("twin/device/viscous_Ns_per_m", 0, 100);
  truth.encoder_step = kMm * file.number("twin/device/encoder_step_mm", 1e-6, 1);
  truth.encoder_angle = kDegree * file.number("twin/device/encoder_angle_deg", 1e-6, 5);
  truth.actuator_tau = 1e-3 * file.number("twin/device/actuator_tau_ms", 0, 100);
  if (file.has("twin/device/weight_N")) truth.weight_N = file.number("twin/device/weight_N", 0, 10);
  if (const double error = kMm * spreadOr0(file, "twin/device/position_error_mm", 10); error > 0) {
    constexpr double kLongestWave = 0.5, kShortestWave = 0.3;  // m
    RandomStream random(seed, "bench.position_error");
    for (int i = 0; i < 3; ++i) {
      truth.position_error.amplitude[i] =
          error * (random.uniform() < 0.5 ? -1 : 1) * random.uniform(0.7, 1.3);
      truth.position_error.wave.row(i) = 2 * std::numbers::pi /
                                         random.uniform(kShortestWave, kLongestWave) *
                                         normal3(random).normalized().transpose();
      truth.position_error.phase[i] = random.uniform(0, 2 * std::numbers::pi);
    }
  }
  return truth;
}

SensorTruth trueSensor(const station::Station& station, std::uint64_t seed) {
  RandomStream random(seed, "bench.force_sensor.truth");
  const JsonFile& file = station.file;
  const station::ForceSensorSetup& believed = *station.design.force_sensor;
  SensorTruth truth;
  const double mass = 0.01 * file.number("twin/force_sensor/tool_mass_spread_percent", 0, 50);
  const double centre = kMm * file.number("twin/force_sensor/centre_spread_mm", 0, 50);
  const double bias = file.number("twin/force_sensor/bias_spread_N", 0, 5);
  const double bias_Nm = file.number("twin/force_sensor/bias_spread_Nm", 0, 1);
  truth.tool_mass = believed.tool.mass * (1 + mass * random.normal());
  truth.p_SM = pack(Vec3(unpack(believed.tool.p_SM) + centre * normal3(random)));
  truth.bias_N = pack(Vec3(unpack(believed.bias.f_S) + bias * normal3(random)));
  truth.bias_Nm = pack(Vec3(unpack(believed.bias.tau_S) + bias_Nm * normal3(random)));
  truth.noise_N = file.number("twin/force_sensor/noise_N", 0, 1);
  truth.noise_Nm = file.number("twin/force_sensor/noise_Nm", 0, 1);
  truth.max_force_N = believed.net_ft.capabilities.max_force_N;
  return truth;
}

Pose trueSample(const station::Station& station, std::uint64_t seed) {
  RandomStream random(seed, "bench.sample");
  Pose X = station.sample->X_WP;
  X.translation() += kMm * spreadOr0(station.file, "twin/sample_spread_mm", 10) * normal3(random);
  return X;
}

Pose boomView(double distance, double aside) {
  const Vec3 p_WC = distance * Vec3(aside, -0.48, 0.877).normalized();
  const Vec3 forward = (Vec3(0, 0.125, 0.02) - p_WC).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized();
  Mat3 R_WC;
  R_WC << right, forward.cross(right), forward;
  return makePose(R_WC, p_WC).inverse();
}

Pose cameraOnBoom(const station::Station& station, std::uint64_t seed) {
  RandomStream random(seed, "bench.boom");
  const double distance =
      kMm * (station.file.number("twin/camera_distance_mm", 100, 3000) +
             station.file.number("twin/camera_distance_spread_mm", 0, 500) * random.normal());
  return boomView(distance, kBoomAside * random.normal());
}

Pose swayed(const Pose& X_CW_boom, double sway, std::int64_t t_ns) {
  const double t = static_cast<double>(t_ns) * 1e-9;
  Pose X = X_CW_boom;
  X.translation() += sway * Vec3(std::sin(2 * std::numbers::pi * 0.23 * t),
                                 std::sin(2 * std::numbers::pi * 0.17 * t + 1), 0);
  return X;
}

double boomSway(const station::Station& station) {
  return kMm * station.file.number("twin/camera_sway_mm", 0, 100);
}

}  // namespace palpa::twin
