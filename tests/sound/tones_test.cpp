#include "apps/sound/tones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/sound/mixer.h"

namespace palpa::sound {
namespace {

constexpr Cue kAll[] = {Cue::beat, Cue::blood, Cue::arterial_blood, Cue::warning, Cue::alarm};

float largestOf(const std::vector<float>& tone) {
  float largest = 0;
  for (const float sample : tone) largest = std::max(largest, std::abs(sample));
  return largest;
}

/// Power of these samples at a frequency (Goertzel's sum, written out).
double powerAt(double frequency_Hz, const std::vector<float>& tone, const Pulse& pulse) {
  const auto first = static_cast<std::size_t>(pulse.start_s * kRate_Hz);
  const auto end = static_cast<std::size_t>((pulse.start_s + pulse.length_s) * kRate_Hz);
  double real = 0, imaginary = 0;
  for (std::size_t i = first; i < end; ++i) {
    const double angle =
        2 * std::numbers::pi * frequency_Hz * static_cast<double>(i - first) / kRate_Hz;
    real += static_cast<double>(tone[i]) * std::cos(angle);
    imaginary += static_cast<double>(tone[i]) * std::sin(angle);
  }
  return real * real + imaginary * imaginary;
}

TEST(Tones, AreAsLoudAsTheirLevelSays) {
  for (const Cue cue : kAll) {
    const Voice voice = voiceOf(cue);
    EXPECT_LE(voice.level_dBFS, -12);
    EXPECT_NEAR(20 * std::log10(static_cast<double>(largestOf(toneOf(voice)))), voice.level_dBFS,
                0.01);
  }
}

TEST(Tones, StayBelowTheLargestNumberAllAtOnce) {
  double sum = 0;
  for (const Cue cue : kAll) sum += amplitudeOf(voiceOf(cue).level_dBFS);
  EXPECT_LT(sum, 1);
}

/// A step of the loudest harmonics, 2 pi sum(k a_k) f / rate, and of the envelope, pi / (2 n) with
/// n samples of attack: both relative to the sum of the harmonics, as the largest sample nearly is.
TEST(Tones, DoNotClick) {
  for (const Cue cue : kAll) {
    const Voice voice = voiceOf(cue);
    const std::vector<float> tone = toneOf(voice);
    double slope = 0, sum = 0, steepest = 0;
    for (std::size_t k = 0; k < voice.harmonics.size(); ++k) {
      slope += static_cast<double>(k + 1) * voice.harmonics[k];
      sum += voice.harmonics[k];
    }
    for (const Pulse& pulse : voice.pulses) {
      EXPECT_LE(pulse.attack_s + pulse.decay_s, pulse.length_s);
      const double shortest = std::min(pulse.attack_s, pulse.decay_s) * kRate_Hz;
      steepest = std::max(steepest, 2 * std::numbers::pi * slope * pulse.pitch_Hz / kRate_Hz +
                                        sum * std::numbers::pi / (2 * shortest));
    }
    // two pulses may overlap; the largest sample is at least half of the harmonics' sum
    const double most = 2 * 2 * steepest / sum * amplitudeOf(voice.level_dBFS);
    for (std::size_t i = 1; i < tone.size(); ++i)
      ASSERT_LE(std::abs(static_cast<double>(tone[i] - tone[i - 1])), most) << i;
    EXPECT_NEAR(tone.front(), 0, 1e-6);
    EXPECT_NEAR(tone.back(), 0, 1e-4);
  }
}

TEST(Tones, BeginAndEndSoftly) {
  for (const Cue cue : kAll) {
    const Voice voice = voiceOf(cue);
    const std::vector<float> tone = toneOf(voice);
    constexpr std::size_t kMillisecond = kRate_Hz / 1000;
    const float soft = 0.05F * largestOf(tone);
    for (std::size_t i = 0; i < kMillisecond; ++i) {
      EXPECT_LE(std::abs(tone[i]), soft);
      EXPECT_LE(std::abs(tone[tone.size() - 1 - i]), soft);
    }
  }
}

TEST(Tones, HaveTheirPitch) {
  for (const Cue cue : kAll) {
    const Voice voice = voiceOf(cue);
    const std::vector<float> tone = toneOf(voice);
    const Pulse& pulse = voice.pulses.front();
    const double fundamental = powerAt(pulse.pitch_Hz, tone, pulse);
    for (const double beside : {0.7, 0.85, 1.18, 1.4, 1.5})
      EXPECT_GT(fundamental, 4 * powerAt(beside * pulse.pitch_Hz, tone, pulse)) << beside;
  }
}

TEST(Tones, OfAnArteryDiffersFromAVeinsInPitchAndRhythm) {
  const Voice vein = voiceOf(Cue::blood), artery = voiceOf(Cue::arterial_blood);
  EXPECT_GT(artery.pulses.front().pitch_Hz, 2 * vein.pulses.front().pitch_Hz);
  EXPECT_NE(artery.pulses.size(), vein.pulses.size());
}

/// IEC 60601-1-8:2006, tables 3 and 4, as tones.h states them.
void expectAsStated(const Voice& voice, std::size_t pulses, double shortest_s, double longest_s) {
  EXPECT_EQ(voice.pulses.size(), pulses);
  for (const Pulse& pulse : voice.pulses) {
    EXPECT_GE(pulse.length_s, shortest_s);
    EXPECT_LE(pulse.length_s, longest_s);
    EXPECT_GE(pulse.attack_s, 0.1 * pulse.length_s);
    EXPECT_LE(pulse.attack_s, 0.4 * pulse.length_s);
    EXPECT_GE(pulse.pitch_Hz, 150);
    EXPECT_LE(pulse.pitch_Hz, 1000);
    ASSERT_EQ(voice.harmonics.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_GE(static_cast<double>(k + 1) * pulse.pitch_Hz, 300);
      EXPECT_LE(static_cast<double>(k + 1) * pulse.pitch_Hz, 4000);
      EXPECT_GE(20 * std::log10(voice.harmonics[k] / voice.harmonics[0]), -15);
    }
  }
}

double gapAfter(const Voice& voice, std::size_t i) {
  return voice.pulses[i + 1].start_s - voice.pulses[i].start_s - voice.pulses[i].length_s;
}

TEST(Alarms, AreBurstsOfTheStandardsPattern) {
  const Voice high = voiceOf(Cue::alarm), medium = voiceOf(Cue::warning);
  expectAsStated(high, 10, 0.075, 0.2);
  expectAsStated(medium, 3, 0.125, 0.25);
  const double x = gapAfter(high, 0), length = high.pulses[0].length_s;
  EXPECT_GE(x, 0.05);
  EXPECT_LE(x, 0.125);
  for (const std::size_t half : {0u, 5u}) {
    EXPECT_NEAR(gapAfter(high, half), x, 1e-9);
    EXPECT_NEAR(gapAfter(high, half + 1), x, 1e-9);
    EXPECT_NEAR(gapAfter(high, half + 2), 2 * x + length, 1e-9);
    EXPECT_NEAR(gapAfter(high, half + 3), x, 1e-9);
  }
  EXPECT_GE(gapAfter(high, 4), 0.35);
  EXPECT_LE(gapAfter(high, 4), 1.3);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_GE(gapAfter(medium, i), 0.125);
    EXPECT_LE(gapAfter(medium, i), 0.25);
  }
  const double burst_s = high.pulses.back().start_s + length;
  EXPECT_LE(1e-9 * static_cast<double>(Score::kAgain_ns) - burst_s, 15);
  EXPECT_GE(1e-9 * static_cast<double>(Score::kAgain_ns) - burst_s, 2.5);
}

std::vector<std::int16_t> rendered(Mixer& mixer, std::size_t samples) {
  std::vector<std::int16_t> block(samples);
  mixer.render(block);
  return block;
}

TEST(Mixer, PutsACueWhereItBelongsToTheSample) {
  const std::vector<float> tone = toneOf(voiceOf(Cue::beat));
  Mixer whole, in_pieces;
  whole.start(Cue::beat, 1234);
  in_pieces.start(Cue::beat, 1234);
  const std::vector<std::int16_t> once = rendered(whole, 9600);
  std::vector<std::int16_t> pieces;
  for (int i = 0; i < 100; ++i)
    for (const std::int16_t sample : rendered(in_pieces, 96)) pieces.push_back(sample);
  EXPECT_EQ(once, pieces);
  for (std::size_t i = 0; i < once.size(); ++i) {
    const bool sounds = i >= 1234 && i - 1234 < tone.size();
    EXPECT_NEAR(once[i], sounds ? 32767 * tone[i - 1234] : 0, 0.51) << i;
  }
}

TEST(Mixer, StartsWhatIsLateWithTheNextBlock) {
  Mixer late, at_once;
  rendered(late, 960);
  rendered(at_once, 960);
  late.start(Cue::alarm, 5);
  at_once.start(Cue::alarm, 960);
  EXPECT_EQ(rendered(late, 4800), rendered(at_once, 4800));
}

TEST(Mixer, FallsSilentWithoutAClick) {
  Mixer mixer;
  mixer.start(Cue::alarm, 0);
  int before = rendered(mixer, 2400).back(), steepest = 0;
  mixer.setAudible(false);
  const std::vector<std::int16_t> falling = rendered(mixer, 960);
  for (const std::int16_t sample : falling) {
    steepest = std::max(steepest, std::abs(sample - before));
    before = sample;
  }
  EXPECT_LT(steepest, 1500);  // of 8230: less than a step of the tone's own at its steepest
  for (std::size_t i = 490; i < falling.size(); ++i) EXPECT_EQ(falling[i], 0) << "after 10 ms";
}

TEST(Mixer, ManyCuesAtOnceStayWithinTheNumbers) {
  Mixer mixer;
  for (int i = 0; i < 100; ++i) mixer.start(Cue::alarm, 0);
  const std::vector<std::int16_t> loud = rendered(mixer, 9600);
  EXPECT_LE(*std::max_element(loud.begin(), loud.end()), 32767);
  EXPECT_GE(*std::min_element(loud.begin(), loud.end()), -32767);
}

TEST(StreamClock, KeepsItsSettingWhileThreadsAreLate) {
  StreamClock clock;
  constexpr std::int64_t kBegin_ns = 7'000'000'000;
  for (int i = 0; i < 1000; ++i) {  // 20 ms each, woken up to 50 ms late
    const std::int64_t late_ns = i * 7919 % 50 * runtime::kMillisecond;
    clock.look(kBegin_ns + i * 20 * runtime::kMillisecond + late_ns, i * 960, 2880);
    EXPECT_EQ(clock.sampleAt(kBegin_ns + 60 * runtime::kMillisecond), 0);
    EXPECT_EQ(clock.sampleAt(kBegin_ns + 1'060'000'000), 48'000);
  }
  EXPECT_EQ(clock.settings(), 1);
}

TEST(StreamClock, IsSetAnewAfterAGap) {
  StreamClock clock;
  clock.look(0, 0, 0);
  clock.look(10'000'000'000, 48'000, 0);  // nine seconds are missing
  EXPECT_EQ(clock.settings(), 2);
  EXPECT_EQ(clock.sampleAt(10'000'000'000), 48'000);
}

}  // namespace
}  // namespace palpa::sound
