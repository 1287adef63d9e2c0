#include "apps/bench/phantom_recording.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "anatomy/base/random.h"

namespace palpa::bench {
namespace {

constexpr double kCutOff_Hz = 60, kRate_Hz = 1000;
constexpr double kSensorAbove = 0.08;  // m from the tip
constexpr double kMassKnown = 1.01, kBias_N = 0.005;
const Mat3 kDown =
    (Mat3() << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished();  // z of S points down the tool

twin::SensorTruth biased(std::uint64_t seed) {
  RandomStream random(seed, "bench.sensor_bias");
  twin::SensorTruth truth;
  for (double& b : truth.bias_N) b = kBias_N * random.normal();
  return truth;
}

}  // namespace

SensedTouch::SensedTouch(std::uint64_t seed, const twin::DeviceTruth& device, Noise noise)
    : device_(device), sensor_(biased(seed), seed), kalman_(noise == Noise::kalman) {
  filter_.low_pass = haptics::butterworth(kCutOff_Hz, kRate_Hz);
  filter_.tool.mass = kMassKnown * twin::SensorTruth{}.tool_mass;
  filter_.tool.p_SM = twin::SensorTruth{}.p_SM;
  filter_.p_SK = {0, 0, kSensorAbove};
  haptics::ReactionSettings settings;
  settings.place_m = device.encoder_step / std::sqrt(12.0);
  settings.tool = filter_.tool;
  settings.p_SK = filter_.p_SK;
  reaction_ = haptics::ReactionFilter(settings);
}

std::pair<Vec3, Vec3> SensedTouch::feel(const Vec3& true_tip, const Vec3& f_touch, double dt) {
  const Pose X_PS = makePose(kDown, true_tip + kSensorAbove * Vec3::UnitZ());
  const PackedPose shown = twin::encoderReading(device_, X_PS);
  const haptics::WrenchSample sample = sensor_.measure(X_PS, f_touch, true_tip, dt, t_ns_);
  const std::int64_t t_ns = t_ns_;
  t_ns_ += std::llround(1e9 * dt);
  if (kalman_) {
    const haptics::Reaction felt = haptics::step(reaction_, reaction_state_, sample, shown, t_ns);
    return {unpack(felt.p_WK), unpack(felt.f_W)};
  }
  const haptics::ContactWrench felt = haptics::step(filter_, state_, sample, shown, t_ns);
  const Vec3 f_r = felt.valid ? Vec3(kDown * unpack(felt.contact.f_S)) : Vec3(Vec3::Zero());
  return {unpack(felt.p_WK), f_r};
}

namespace {
constexpr double kPairStarts = 2e-3;  // m above the surface
}

LedPair::LedPair(double shift, double apart)
    : half_(0.5 * apart),
      tips_{twin::LedTip(Vec3(shift + half_, 0, kPairStarts)),
            twin::LedTip(Vec3(shift - half_, 0, kPairStarts))} {}

LedPair& LedPair::go(double shift, const std::array<double, 2>& depths, double seconds,
                     double hold) {
  tips_[0].go({shift + half_, 0, -depths[0]}, seconds, hold);
  tips_[1].go({shift - half_, 0, -depths[1]}, seconds, hold);
  return *this;
}

PhantomTick TouchRecorder::record(const Vec3& true_tip, const twin::PhantomTouch& truth) {
  PhantomTick tick;
  tick.true_tip = tick.tip = true_tip;
  tick.truth = truth;
  tick.f_r = truth.f;
  if (noise_ != Noise::none)
    std::tie(tick.tip, tick.f_r) = sensed_.feel(true_tip, truth.f, kPhantomTick);
  if (before_) tick.dp = tick.tip - *before_;
  before_ = tick.tip;
  return tick;
}

namespace {

std::size_t ticksOf(double duration) { return static_cast<std::size_t>(duration / kPhantomTick); }

}  // namespace

const char* nameOf(Noise noise) { return noise == Noise::none ? "none" : "realistic"; }

const char* clearedBy(Noise noise) {
  if (noise == Noise::none) return "nothing";
  return noise == Noise::kalman ? "kalman" : "low-pass";
}

std::vector<PhantomTick> recordTouch(twin::PhantomTwin phantom, const twin::LedTip& tip,
                                     Noise noise, std::uint64_t seed) {
  TouchRecorder recorder(noise, seed);
  std::vector<PhantomTick> ticks;
  for (std::size_t i = 0; i < ticksOf(tip.duration()); ++i) {
    const Vec3 at = tip.at(static_cast<double>(i) * kPhantomTick);
    ticks.push_back(recorder.record(at, phantom.step(at, kPhantomTick)));
  }
  return ticks;
}

std::vector<std::array<PhantomTick, 2>> recordTouches(twin::PhantomPairTwin phantom,
                                                      const LedPair& tips, Noise noise,
                                                      std::uint64_t seed) {
  std::array<TouchRecorder, 2> recorders{TouchRecorder(noise, seed),
                                         TouchRecorder(noise, seed + 1'000'000)};
  std::vector<std::array<PhantomTick, 2>> ticks;
  for (std::size_t i = 0; i < ticksOf(tips.duration()); ++i) {
    const std::array<Vec3, 2> at = tips.at(static_cast<double>(i) * kPhantomTick);
    const std::array<twin::PhantomTouch, 2> truth = phantom.step(at, kPhantomTick);
    ticks.push_back({recorders[0].record(at[0], truth[0]), recorders[1].record(at[1], truth[1])});
  }
  return ticks;
}

namespace {

Vec3 turnedOver(const Vec3& v) { return {v.x(), v.y(), -v.z()}; }

twin::PhantomTouch turnedOver(twin::PhantomTouch touch) {
  for (Vec3* const v : {&touch.f, &touch.n, &touch.lump}) *v = turnedOver(*v);
  return touch;
}

}  // namespace

std::vector<std::array<PhantomTick, 2>> recordOpposed(twin::OpposedPhantomTwin phantom,
                                                      const std::array<twin::LedTip, 2>& tips,
                                                      Noise noise, std::uint64_t seed) {
  std::array<TouchRecorder, 2> recorders{TouchRecorder(noise, seed),
                                         TouchRecorder(noise, seed + 1'000'000)};
  const double thickness = phantom.thickness(),
               duration = std::max(tips[0].duration(), tips[1].duration());
  std::vector<std::array<PhantomTick, 2>> ticks;
  for (std::size_t i = 0; i < ticksOf(duration); ++i) {
    const double t = static_cast<double>(i) * kPhantomTick;
    const std::array<Vec3, 2> led{tips[0].at(t), tips[1].at(t)};
    const std::array<twin::PhantomTouch, 2> truth =
        phantom.step({led[0], twin::mirroredInSlab(led[1], thickness)}, kPhantomTick);
    PhantomTick below = recorders[1].record(led[1], turnedOver(truth[1]));
    below.tip = twin::mirroredInSlab(below.tip, thickness);
    below.true_tip = twin::mirroredInSlab(below.true_tip, thickness);
    below.dp = turnedOver(below.dp);
    below.f_r = turnedOver(below.f_r);
    below.truth = truth[1];
    ticks.push_back({recorders[0].record(led[0], truth[0]), below});
  }
  return ticks;
}

}  // namespace palpa::bench
