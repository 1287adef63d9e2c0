#include "apps/bench/phantom_recording.h"

#include "apps/runtime/random.h"
#include "apps/twin/device_twin.h"
#include "apps/twin/sensor_twin.h"
#include "haptics/sensors/wrench_filter.h"

namespace palpa::bench {
namespace {

constexpr double kCutOff_Hz = 60;
constexpr double kSensorAbove = 0.08;   // m from the tip to the sensor

/// Encoders and a sensor on the last link; its tool's mass was identified to 1 %, its bias to 5 mN [chosen].
class Feeling {
 public:
  explicit Feeling(std::uint64_t seed) : sensor_(truthOf(seed), seed) {
    filter_.low_pass = haptics::butterworth(kCutOff_Hz, 1 / kPhantomTick);
    filter_.tool.mass = 1.01 * twin::SensorTruth{}.tool_mass;
    filter_.tool.p_SM = twin::SensorTruth{}.p_SM;
  }

  void feel(const Vec3& f_contact, std::int64_t t_ns, PhantomTick* tick) {
    const Pose X_PS = makePose(kDown, tick->true_tip + kSensorAbove * Vec3::UnitZ());
    const PackedPose shown = twin::encoderReading(twin::DeviceTruth{}, X_PS);
    const haptics::WrenchSample sample = sensor_.measure(X_PS, f_contact, tick->true_tip, kPhantomTick, t_ns);
    const haptics::ContactWrench felt = haptics::step(filter_, state_, sample, shown, t_ns);
    if (felt.valid) tick->f_r = kDown * unpack(felt.contact.f_S);
    const Vec3 p = before_;   // the wrench is that of one call ago
    before_ = unpack(shown).translation();
    if (!started_) haptics::settle(filter_.low_pass, place_, {before_.x(), before_.y(), before_.z()});
    const auto y = started_ ? haptics::apply(filter_.low_pass, place_, {p.x(), p.y(), p.z()}) : std::array<double, 3>{before_.x(), before_.y(), before_.z()};
    started_ = true;
    tick->tip = Vec3(y[0], y[1], y[2]) - kSensorAbove * Vec3::UnitZ();
  }

 private:
  static twin::SensorTruth truthOf(std::uint64_t seed) {
    runtime::RandomStream random(seed, "bench.sensor_bias");
    twin::SensorTruth truth;
    for (double& b : truth.bias_N) b = 0.005 * random.normal();
    return truth;
  }
  inline static const Mat3 kDown = (Mat3() << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished();   // z of S points down the tool
  twin::SensorTwin sensor_;
  haptics::WrenchFilter filter_;
  haptics::WrenchFilterState state_;
  haptics::LowPassState<3> place_;
  Vec3 before_ = Vec3::Zero();
  bool started_ = false;
};

}  // namespace

const char* nameOf(Noise noise) { return noise == Noise::none ? "none" : "realistic"; }

std::vector<PhantomTick> recordTouch(twin::PhantomTwin phantom, const LedTip& tip, Noise noise, std::uint64_t seed) {
  Feeling feeling(seed);
  std::vector<PhantomTick> ticks(static_cast<std::size_t>(tip.duration() / kPhantomTick));
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    PhantomTick& tick = ticks[i];
    tick.true_tip = tip.at(static_cast<double>(i) * kPhantomTick);
    tick.truth = phantom.step(tick.true_tip, kPhantomTick);
    tick.tip = tick.true_tip;
    tick.f_r = tick.truth.f;
    if (noise == Noise::realistic) {
      tick.f_r.setZero();
      feeling.feel(tick.truth.f, static_cast<std::int64_t>(i) * 1'000'000, &tick);
    }
    if (i > 0) tick.dp = tick.tip - ticks[i - 1].tip;
  }
  return ticks;
}

}  // namespace palpa::bench
