#pragma once

#include <cstdint>
#include <deque>

#include "anatomy/base/random.h"
#include "apps/assess/pulse/pulse_trial.h"
#include "haptics/flight_record.h"

namespace palpa::task_pulse {

/// What every heart has in common; the figures and their sources are in the task's file.
struct HeartFigures {
  double sdnn_s = 0.05;        ///< standard deviation of the intervals of a sinus rhythm ...
  double sdnn_at_s = 0.926;    ///< ... of this mean interval; relative, as the interval is long
  double breath_share = 0.6;   ///< of its variance that breathing makes
  double breath_s = 4;         ///< a breath
  double breath_strength = 0;  ///< by how much it changes a beat's strength, up and down
  /// A premature beat comes after so many others
  int fewest_between = 4, most_between = 9;
  double coupling = 0.62, coupling_sd = 0.06;  ///< of the interval before it, in the usual one
  double potentiation = 0.1;                   ///< by how much the beat after the pause is stronger
  double fibrillation_cv = 0.24;               ///< of intervals
  double shortest_s = 0.28;                    ///< that the node between atria and chambers lets by
  double relaxes_s = 0.25, fills_s = 0.25;     ///< a_0 and tau of `filling`
  double opens_at = 0.5;                       ///< a weaker contraction sends no pulse
};

/// Strength of a beat after an interval of `interval` s, in that after the usual one: what flows
/// into a chamber that relaxes for a_0 and then fills with the time constant tau
///     s = (1 - exp(-(i - a_0) / tau)) / (1 - exp(-(i_usual - a_0) / tau)),   0 for i <= a_0
double filling(const HeartFigures& figures, double interval, double usual);

/// The beats of one heart, one after the other, from a named random stream. Intervals:
///     regular: I (1 + c (sqrt(2 q) sin(2 pi t / breath) + sqrt(1 - q) n)),  c = SDNN / SDNN's I,
///              times I by it: what varies is more, the slower the heart; n normal
///     premature: now and then one after k I, k normal, and after it the rest of 2 I
///              (a full compensatory pause)
///     irregular: shortest + X, X log-normal, each apart from all others, mean I, deviation cv I
/// A contraction weaker than `opens_at` sends no pulse, and is no beat here.
class Heart {
 public:
  Heart(const HeartFigures& figures, assess::PulseRhythm rhythm, double rate_per_min,
        std::uint64_t seed);
  /// s since the first contraction; strength in usual beats.
  struct Beat {
    double t_s = 0;
    double strength = 0;
    bool premature = false;
  };
  Beat next();

 private:
  Beat contraction();
  double breath() const;  ///< -1 to 1, now
  double sinusInterval();
  double fibrillationInterval();

  HeartFigures figures_;
  assess::PulseRhythm rhythm_;
  double usual_s_;
  RandomStream random_;
  double t_s_ = 0, phase_ = 0;
  double pause_s_ = 0;  ///< what follows a premature beat; 0: it was none
  int until_premature_ = 0;
};

/// What the tick is told of a heart: the beats whose waves may go on, and those to come.
class BeatSchedule {
 public:
  /// Waves last no longer; nothing that is told to the tick changes afterwards.
  static constexpr std::int64_t kWave_ns = 750'000'000;
  BeatSchedule(Heart heart, std::int64_t first_ns);
  std::array<haptics::PulseBeat, haptics::kMostBeats> at(std::int64_t now_ns);

 private:
  Heart heart_;
  std::int64_t first_ns_;
  std::deque<haptics::PulseBeat> beats_;
};

}  // namespace palpa::task_pulse
