#include "apps/sound/tones.h"

#include <algorithm>
#include <cmath>

namespace palpa::sound {
namespace {

constexpr double kC5_Hz = 523.25, kA4_Hz = 440, kG4_Hz = 392, kD4_Hz = 293.66, kB5_Hz = 987.77;

const std::vector<double> kSoft{1, 0.2};
const std::vector<double> kBright{1, 0.5, 0.25};
const std::vector<double> kOfAnAlarm{1, 0.6, 0.4, 0.25};  // 0, -4, -8, -12 dB

/// [chosen] within what IEC 60601-1-8 says of high priority.
std::vector<Pulse> highBurst() {
  constexpr double kLength = 0.12, kGap = 0.08, kMiddle = 0.5;  // s
  constexpr double kGaps[] = {kGap, kGap, 2 * kGap + kLength, kGap, kMiddle,
                              kGap, kGap, 2 * kGap + kLength, kGap};
  std::vector<Pulse> pulses{{0, kLength, kC5_Hz, 0.02, 0.04}};
  for (const double gap : kGaps) {
    pulses.push_back(pulses.back());
    pulses.back().start_s += kLength + gap;
  }
  return pulses;
}

/// [chosen] as above, of medium priority.
std::vector<Pulse> mediumBurst() {
  return {{0, 0.18, kC5_Hz, 0.03, 0.06},
          {0.36, 0.18, kC5_Hz, 0.03, 0.06},
          {0.72, 0.18, kC5_Hz, 0.03, 0.06}};
}

double raisedCosine(double share) {
  return share >= 1 ? 1 : 0.5 * (1 - std::cos(M_PI * std::max(share, 0.0)));
}

double envelope(const Pulse& pulse, double t_s) {
  return raisedCosine(t_s / pulse.attack_s) * raisedCosine((pulse.length_s - t_s) / pulse.decay_s);
}

std::size_t samplesIn(double seconds) {
  return static_cast<std::size_t>(std::llround(seconds * kRate_Hz));
}

void addPulse(const Pulse& pulse, const std::vector<double>& harmonics, std::vector<float>* tone) {
  const std::size_t first = samplesIn(pulse.start_s), count = samplesIn(pulse.length_s) + 1;
  tone->resize(std::max(tone->size(), first + count), 0.0F);
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = static_cast<double>(i) / kRate_Hz;
    double value = 0;
    for (std::size_t k = 0; k < harmonics.size(); ++k)
      value +=
          harmonics[k] * std::sin(2 * M_PI * static_cast<double>(k + 1) * pulse.pitch_Hz * t_s);
    (*tone)[first + i] += static_cast<float>(envelope(pulse, t_s) * value);
  }
}

}  // namespace

/// Pitches, lengths and levels [chosen]: quiet beside speech, each told from the others by its
/// rhythm as well as by its pitch, which not everybody can name.
Voice voiceOf(Cue cue) {
  switch (cue) {
    case Cue::beat:
      return {{{0, 0.08, kA4_Hz, 0.02, 0.06}}, kSoft, -36};
    case Cue::blood:  // two, falling
      return {{{0, 0.16, kG4_Hz, 0.03, 0.08}, {0.14, 0.24, kD4_Hz, 0.03, 0.16}}, kSoft, -24};
    case Cue::arterial_blood:  // three, high and short
      return {{{0, 0.09, kB5_Hz, 0.015, 0.05},
               {0.13, 0.09, kB5_Hz, 0.015, 0.05},
               {0.26, 0.09, kB5_Hz, 0.015, 0.05}},
              kBright,
              -20};
    case Cue::warning:
      return {mediumBurst(), kOfAnAlarm, -18};
    case Cue::alarm:
      return {highBurst(), kOfAnAlarm, -12};
  }
  return {};
}

double amplitudeOf(double level_dBFS) { return std::pow(10, level_dBFS / 20); }

std::vector<float> toneOf(const Voice& voice) {
  std::vector<float> tone;
  for (const Pulse& pulse : voice.pulses) addPulse(pulse, voice.harmonics, &tone);
  float largest = 0;
  for (const float sample : tone) largest = std::max(largest, std::abs(sample));
  if (largest == 0) return tone;
  const float scale = static_cast<float>(amplitudeOf(voice.level_dBFS)) / largest;
  for (float& sample : tone) sample *= scale;
  return tone;
}

}  // namespace palpa::sound
