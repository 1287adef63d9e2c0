#include "apps/bench/sensed_touch.h"

#include <cmath>

#include "apps/runtime/random.h"

namespace palpa::bench {
namespace {

constexpr double kCutOff_Hz = 60, kRate_Hz = 1000;
constexpr double kSensorAbove = 0.08;  // m from the tip
constexpr double kMassKnown = 1.01, kBias_N = 0.005;
const Mat3 kDown =
    (Mat3() << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished();  // z of S points down the tool

twin::SensorTruth biased(std::uint64_t seed) {
  runtime::RandomStream random(seed, "bench.sensor_bias");
  twin::SensorTruth truth;
  for (double& b : truth.bias_N) b = kBias_N * random.normal();
  return truth;
}

}  // namespace

SensedTouch::SensedTouch(std::uint64_t seed, const twin::DeviceTruth& device)
    : device_(device), sensor_(biased(seed), seed) {
  filter_.low_pass = haptics::butterworth(kCutOff_Hz, kRate_Hz);
  filter_.tool.mass = kMassKnown * twin::SensorTruth{}.tool_mass;
  filter_.tool.p_SM = twin::SensorTruth{}.p_SM;
  filter_.p_SK = {0, 0, kSensorAbove};
}

std::pair<Vec3, Vec3> SensedTouch::feel(const Vec3& true_tip, const Vec3& f_touch, double dt) {
  const Pose X_PS = makePose(kDown, true_tip + kSensorAbove * Vec3::UnitZ());
  const PackedPose shown = twin::encoderReading(device_, X_PS);
  const haptics::WrenchSample sample = sensor_.measure(X_PS, f_touch, true_tip, dt, t_ns_);
  const haptics::ContactWrench felt = haptics::step(filter_, state_, sample, shown, t_ns_);
  t_ns_ += std::llround(1e9 * dt);
  const Vec3 f_r = felt.valid ? Vec3(kDown * unpack(felt.contact.f_S)) : Vec3(Vec3::Zero());
  return {unpack(felt.p_WK), f_r};
}

}  // namespace palpa::bench
