#include "apps/bench/phantom_recording.h"

#include <optional>
#include <tuple>

#include "apps/bench/sensed_touch.h"

namespace palpa::bench {
namespace {

/// What one tool feels, tick after tick.
class TouchRecorder {
 public:
  TouchRecorder(Noise noise, std::uint64_t seed) : noise_(noise), sensed_(seed) {}
  PhantomTick record(const Vec3& true_tip, const twin::PhantomTouch& truth) {
    PhantomTick tick;
    tick.true_tip = tick.tip = true_tip;
    tick.truth = truth;
    tick.f_r = truth.f;
    if (noise_ == Noise::realistic)
      std::tie(tick.tip, tick.f_r) = sensed_.feel(true_tip, truth.f, kPhantomTick);
    if (before_) tick.dp = tick.tip - *before_;
    before_ = tick.tip;
    return tick;
  }

 private:
  Noise noise_;
  SensedTouch sensed_;
  std::optional<Vec3> before_;
};

std::size_t ticksOf(double duration) { return static_cast<std::size_t>(duration / kPhantomTick); }

}  // namespace

const char* nameOf(Noise noise) { return noise == Noise::none ? "none" : "realistic"; }

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

}  // namespace palpa::bench
