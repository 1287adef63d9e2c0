#include "apps/bench/contact_study.h"

#include <cmath>
#include <vector>

namespace palpa::bench {
namespace {

constexpr double kPulseComes = 1, kPulseHolds = 9;  // s: down, then held still
constexpr double kPulseJudged = 4;                  // s: from here on all is steady
constexpr int kPulseParts = 8;                      // a tick's
constexpr std::uint64_t kPulseSeed = 71;
constexpr std::int64_t kASecond_ns = 1'000'000'000;

/// Who presses: the source by itself, through the loop, or nobody.
enum class Beats { none, source, loop };

/// Beats once a second, told as a task tells them: those that go on and those to come.
void tellBeats(std::int64_t now_ns, haptics::PulsingArtery* artery) {
  for (std::size_t i = 0; i < artery->beats.size(); ++i)
    artery->beats[i] = {(now_ns / kASecond_ns - 1 + static_cast<std::int64_t>(i)) * kASecond_ns, 1};
}

struct PressedPulse {
  std::vector<double> hand_N;  ///< along the normal, a tick each, once all is steady
  double f_n = 0;              ///< N, mean, of the phantom
};

PressedPulse pressPulse(const twin::PhantomTwin& start, const PulseCase& one, Beats beats) {
  twin::LedTip way(Vec3(one.beside, 0, 2e-3));
  way.go(Vec3(one.beside, 0, -one.pressed), kPulseComes, kPulseHolds);
  twin::PhantomTwin phantom = start;
  twin::DeviceTwin device(one.truth, makePose(Mat3::Identity(), way.at(0)));
  SensedTouch sensed(kPulseSeed, one.truth, one.noise);
  haptics::TouchAugmentationState touch;
  haptics::PulseState loop_state, source_state;
  haptics::PulsingArtery artery = one.artery;
  twin::PhantomTouch felt;
  PressedPulse pressed;
  for (std::int64_t k = 0; k < std::llround(way.duration() / kPhantomTick); ++k) {
    const std::int64_t now_ns = k * std::llround(1e9 * kPhantomTick);
    const double t = 1e-9 * static_cast<double>(now_ns);
    tellBeats(now_ns, &artery);
    const auto [tip, f_r] = sensed.feel(device.truePose().translation(), felt.f, kPhantomTick);
    Vec3 f_d = Vec3::Zero(), f_source = Vec3::Zero();
    if (beats == Beats::loop) {
      const Vec3 p_M = tip + one.law.tip_radius * Vec3::UnitZ();
      const haptics::AugmentedTouch now =
          haptics::augmentTouch(one.law, {}, {{{true, p_M, f_r}, {}}}, kPhantomTick, &touch);
      const haptics::Modulated& at = now.touch[0];
      f_d = now.f_d[0] + haptics::feelPulse(
                             one.pulse, artery,
                             {at.contact, Vec3(p_M - one.law.tip_radius * at.u_n), at.u_n, at.f_n},
                             now_ns, kPhantomTick, &loop_state);
    }
    for (int i = 1; i <= kPulseParts; ++i) {
      const double part = kPhantomTick / kPulseParts;
      if (beats == Beats::source)
        f_source = haptics::feelPulse(
            one.pulse, artery, {felt.contact, device.truePose().translation(), felt.n, felt.f_n},
            now_ns + std::llround(1e9 * i * part), part, &source_state);
      device.advance(part, makePose(Mat3::Identity(), way.at(t - kPhantomTick + i * part)),
                     one.grip, f_d, felt.f + f_source);
      felt = phantom.step(device.truePose().translation(), part);
    }
    if (t < kPulseJudged) continue;
    pressed.hand_N.push_back(device.meanFingerForce().z());
    pressed.f_n += felt.f_n;
  }
  pressed.f_n /= static_cast<double>(pressed.hand_N.size());
  return pressed;
}

}  // namespace

double pulseError(const twin::PhantomTwin& phantom, PulseCase one) {
  const PressedPulse quiet = pressPulse(phantom, one, Beats::none);
  one.artery.best_N = quiet.f_n;
  const PressedPulse source = pressPulse(phantom, one, Beats::source),
                     loop = pressPulse(phantom, one, Beats::loop);
  RelativeRms error;
  for (std::size_t i = 0; i < quiet.hand_N.size(); ++i)
    error.add((loop.hand_N[i] - source.hand_N[i]) * Vec3::UnitZ(),
              (source.hand_N[i] - quiet.hand_N[i]) * Vec3::UnitZ());
  return error.value();
}

}  // namespace palpa::bench
