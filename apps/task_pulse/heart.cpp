#include "apps/task_pulse/heart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/base/pinned_math.h"

namespace palpa::task_pulse {

using assess::PulseRhythm;

namespace {

constexpr double kSlowest = 1.5, kFastest = 0.5;  // of a sinus interval, in the usual one
constexpr double kLeastCoupling = 0.45, kMostCoupling = 0.8;

}  // namespace

double filling(const HeartFigures& figures, double interval, double usual) {
  const auto filled = [&](double i) {
    return i > figures.relaxes_s ? -pinned::expm1(-(i - figures.relaxes_s) / figures.fills_s) : 0.0;
  };
  const double most = filled(usual);
  return most > 0 ? filled(interval) / most : 0;
}

Heart::Heart(const HeartFigures& figures, PulseRhythm rhythm, double rate_per_min,
             std::uint64_t seed)
    : figures_(figures),
      rhythm_(rhythm),
      usual_s_(60 / rate_per_min),
      random_(seed, "pulse.heart") {
  phase_ = random_.uniform();
  until_premature_ = figures.fewest_between;
}

Heart::Beat Heart::next() {
  for (;;) {
    const Beat beat = contraction();
    if (beat.strength >= figures_.opens_at) return beat;
  }
}

/// What its intervals are is drawn in this order; a heart's beats are told by its seed.
Heart::Beat Heart::contraction() {
  Beat beat;
  const double interval = rhythm_ == PulseRhythm::irregular ? fibrillationInterval()
                          : pause_s_ > 0                    ? pause_s_
                                                            : sinusInterval();
  const bool after_pause = pause_s_ > 0;
  double share = 1;
  if (rhythm_ == PulseRhythm::premature && !after_pause && --until_premature_ < 0) {
    beat.premature = true;
    share = std::clamp(random_.normal(figures_.coupling, figures_.coupling_sd), kLeastCoupling,
                       kMostCoupling);
    const int more = figures_.most_between - figures_.fewest_between;
    until_premature_ = figures_.fewest_between + static_cast<int>(random_.uniform() * (more + 1));
  }
  pause_s_ = beat.premature ? (2 - share) * usual_s_ : 0;
  t_s_ += share * interval;
  beat.t_s = t_s_;
  beat.strength = 1 + figures_.breath_strength * breath();
  if (beat.premature || rhythm_ == PulseRhythm::irregular)
    beat.strength *= filling(figures_, share * interval, usual_s_);
  if (after_pause) beat.strength *= 1 + figures_.potentiation;
  return beat;
}

double Heart::breath() const {
  return pinned::sin(2 * std::numbers::pi * (phase_ + std::fmod(t_s_ / figures_.breath_s, 1.0)));
}

double Heart::sinusInterval() {
  const double c = figures_.sdnn_s / figures_.sdnn_at_s * usual_s_ / figures_.sdnn_at_s;
  const double varies = std::sqrt(2 * figures_.breath_share) * breath() +
                        std::sqrt(1 - figures_.breath_share) * random_.normal();
  return usual_s_ * std::clamp(1 + c * varies, kFastest, kSlowest);
}

double Heart::fibrillationInterval() {
  const double mean = std::max(usual_s_ - figures_.shortest_s, 0.01),
               cv = figures_.fibrillation_cv * usual_s_ / mean, s2 = pinned::log1p(cv * cv);
  return figures_.shortest_s + mean * pinned::exp(std::sqrt(s2) * random_.normal() - 0.5 * s2);
}

BeatSchedule::BeatSchedule(Heart heart, std::int64_t first_ns)
    : heart_(heart), first_ns_(first_ns) {}

std::array<haptics::PulseBeat, haptics::kMostBeats> BeatSchedule::at(std::int64_t now_ns) {
  while (!beats_.empty() && beats_.front().start_ns + kWave_ns < now_ns) beats_.pop_front();
  while (beats_.size() < haptics::kMostBeats) {
    const Heart::Beat beat = heart_.next();
    beats_.push_back({first_ns_ + std::llround(1e9 * beat.t_s), beat.strength});
  }
  std::array<haptics::PulseBeat, haptics::kMostBeats> all;
  std::copy_n(beats_.begin(), all.size(), all.begin());
  return all;
}

}  // namespace palpa::task_pulse
