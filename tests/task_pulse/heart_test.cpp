#include "apps/task_pulse/heart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace palpa::task_pulse {
namespace {

using assess::PulseRhythm;

struct Beating {
  std::vector<Heart::Beat> beats;
  std::vector<double> intervals;

  Beating(PulseRhythm rhythm, double rate, int count, std::uint64_t seed = 7) {
    Heart heart(HeartFigures{}, rhythm, rate, seed);
    for (int i = 0; i < count; ++i) {
      beats.push_back(heart.next());
      if (i > 0) intervals.push_back(beats[beats.size() - 1].t_s - beats[beats.size() - 2].t_s);
    }
  }
  double mean() const {
    return (beats.back().t_s - beats.front().t_s) / static_cast<double>(intervals.size());
  }
  double deviation() const {
    double sum = 0;
    for (const double i : intervals) sum += (i - mean()) * (i - mean());
    return std::sqrt(sum / static_cast<double>(intervals.size()));
  }
};

/// SDNN of 50 ms at 926 ms (Nunan 2010), relatively as much more as the heart is slower.
TEST(Heart, ASinusRhythmVariesAsHeartsAtRestDo) {
  for (const double rate : {50.0, 64.8, 100.0, 150.0}) {
    const Beating b(PulseRhythm::regular, rate, 4000);
    const double usual = 60 / rate;
    EXPECT_NEAR(b.mean(), usual, 0.005 * usual);
    EXPECT_NEAR(b.deviation(), 0.05 * (usual / 0.926) * (usual / 0.926), 0.06 * b.deviation());
  }
}

TEST(Heart, ABreathIsHeardInIt) {
  const Beating b(PulseRhythm::regular, 75, 3000);
  double cosine = 0, sine = 0;
  for (std::size_t i = 0; i < b.intervals.size(); ++i) {
    const double phase = 2 * std::numbers::pi * b.beats[i + 1].t_s / 4;
    cosine += (b.intervals[i] - b.mean()) * std::cos(phase);
    sine += (b.intervals[i] - b.mean()) * std::sin(phase);
  }
  const double amplitude = 2 * std::hypot(cosine, sine) / static_cast<double>(b.intervals.size());
  EXPECT_NEAR(0.5 * amplitude * amplitude / (b.deviation() * b.deviation()),
              HeartFigures{}.breath_share, 0.05);
}

TEST(Heart, APrematureBeatIsEarlyWeakAndFollowedByAPause) {
  const Beating b(PulseRhythm::premature, 65, 3000);
  const double usual = 60.0 / 65;
  int premature = 0;
  double early = 0;
  for (std::size_t i = 1; i + 1 < b.beats.size(); ++i) {
    if (!b.beats[i].premature) continue;
    ++premature;
    early += b.intervals[i - 1] / usual;
    EXPECT_LT(b.beats[i].strength, 1);
    EXPECT_GT(b.beats[i + 1].strength, b.beats[i].strength);
    EXPECT_NEAR(b.intervals[i - 1] + b.intervals[i], 2 * usual, 0.25 * usual);
  }
  EXPECT_NEAR(early / premature, 0.62, 0.03);
  const double share = premature / static_cast<double>(b.beats.size());
  EXPECT_GT(share, 1.0 / 11);
  EXPECT_LT(share, 1.0 / 6);
  EXPECT_NEAR(b.mean(), usual, 0.02 * usual);  // the pause gives back what came early
}

/// The same relative variation at every rate (Tateno and Glass 2001), each interval apart.
TEST(Heart, FibrillationIsIrregularlyIrregular) {
  for (const double rate : {60.0, 80.0, 100.0}) {
    const Beating b(PulseRhythm::irregular, rate, 6000);
    EXPECT_NEAR(b.deviation() / b.mean(), 0.24, 0.02);
    double product = 0;
    for (std::size_t i = 1; i < b.intervals.size(); ++i)
      product += (b.intervals[i] - b.mean()) * (b.intervals[i - 1] - b.mean());
    EXPECT_LT(std::abs(product / static_cast<double>(b.intervals.size())),
              0.06 * b.deviation() * b.deviation());
  }
}

TEST(Heart, AShorterFillingIsAWeakerBeat) {
  const HeartFigures figures;
  EXPECT_EQ(filling(figures, 0.2, 0.8), 0);
  EXPECT_NEAR(filling(figures, 0.8, 0.8), 1, 1e-12);
  EXPECT_GT(filling(figures, 1.2, 0.8), 1);
  for (const Heart::Beat& beat : Beating(PulseRhythm::irregular, 100, 2000).beats)
    EXPECT_GE(beat.strength, figures.opens_at);
}

TEST(Heart, ASeedTellsAllOfIt) {
  const Beating a(PulseRhythm::premature, 70, 50), b(PulseRhythm::premature, 70, 50),
      c(PulseRhythm::premature, 70, 50, 8);
  EXPECT_EQ(a.intervals, b.intervals);
  EXPECT_NE(a.intervals, c.intervals);
}

/// What is told never changes afterwards, is told before it begins and until its wave is over.
TEST(BeatSchedule, ABeatIsToldWellBeforeItAndAsLongAsItsWave) {
  for (const PulseRhythm rhythm :
       {PulseRhythm::regular, PulseRhythm::premature, PulseRhythm::irregular}) {
    BeatSchedule schedule(Heart(HeartFigures{}, rhythm, 110, 3), 1'000'000'000);
    std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>> told;  // first and last time
    std::map<std::int64_t, double> strength;
    for (std::int64_t now = 0; now < 60'000'000'000; now += 16'666'667)
      for (const haptics::PulseBeat& beat : schedule.at(now)) {
        told.try_emplace(beat.start_ns, now, now).first->second.second = now;
        EXPECT_EQ(strength.try_emplace(beat.start_ns, beat.strength).first->second, beat.strength);
      }
    EXPECT_GT(told.size(), 90u);
    for (const auto& [start, times] : told) {
      if (start > 58'000'000'000) break;
      EXPECT_LT(times.first, start - 200'000'000) << "0.2 s before it";
      EXPECT_GT(times.second, start + 700'000'000) << "until its wave is over";
    }
  }
}

}  // namespace
}  // namespace palpa::task_pulse
