#pragma once

#include <cstdint>
#include <vector>

#include "apps/sound/score.h"

namespace palpa::sound {

inline constexpr int kRate_Hz = 48'000;

/// One pulse of a cue: a harmonic tone under a raised-cosine envelope,
///     s(t) = e(t) sum over k = 1..4 of a_k sin(2 pi k f t)
///     e    = (1 - cos(pi t / attack)) / 2 at its beginning, likewise at its end, 1 between
/// so that neither end clicks: value and slope are 0 there.
struct Pulse {
  double start_s = 0, length_s = 0.1;
  double pitch_Hz = 440;                   ///< f, of the fundamental
  double attack_s = 0.02, decay_s = 0.03;  ///< together at most the length
};

/// How a cue sounds. Levels: dBFS of the largest sample, 0 dBFS being the largest number that the
/// device takes; how loud that is, the computer's own volume says. All cues at once stay below 0.
///
/// warning, alarm: after the bursts of medium and high priority of IEC 60601-1-8:2006 (tables 3 and
/// 4). There
///     pulses in a burst       3 (medium), 10 (high)
///     length of a pulse       125 to 250 ms (medium), 75 to 200 ms (high)
///     rise of a pulse         10 to 40 % of its length
///     between pulses          y = 125 to 250 ms (medium), x = 50 to 125 ms (high); of the ten:
///                             x, x, 2 x + length, x, 0.35 to 1.3 s, x, x, 2 x + length, x
///     between bursts          2.5 to 30 s (medium), 2.5 to 15 s (high)
///     pitch                   150 to 1000 Hz, at least four harmonics between 300 and 4000 Hz,
///     each
///                             within 15 dB of the fundamental
/// Palpa is no medical device and does not claim that standard: a sound that means danger elsewhere
/// shall mean no other thing here.
struct Voice {
  std::vector<Pulse> pulses;
  std::vector<double> harmonics;  ///< a_1 (1) to a_4
  double level_dBFS = -20;
};
Voice voiceOf(Cue cue);

/// Its samples, -1 to 1, at kRate_Hz; the largest is as large as its level says.
std::vector<float> toneOf(const Voice& voice);

/// Of a level: -20 dBFS is 0.1.
double amplitudeOf(double level_dBFS);

}  // namespace palpa::sound
