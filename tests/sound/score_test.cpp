#include "apps/sound/score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace palpa::sound {
namespace {

constexpr std::int64_t kStep_ns = 5 * runtime::kMillisecond;

Seen running() { return {.trial = 1, .running = true}; }

/// What starts while `of` says what is seen at each moment, from 0 to `end_ns`.
template <class Of>
std::vector<CueStart> played(Score& score, std::int64_t end_ns, const Of& of) {
  std::vector<CueStart> all;
  for (std::int64_t now_ns = 0; now_ns <= end_ns; now_ns += kStep_ns)
    for (const CueStart& start : score.next(of(now_ns), now_ns)) all.push_back(start);
  return all;
}

std::vector<std::int64_t> timesOf(Cue cue, const std::vector<CueStart>& starts) {
  std::vector<std::int64_t> times;
  for (const CueStart& start : starts)
    if (start.cue == cue) times.push_back(start.t_ns);
  return times;
}

TEST(Beat, ComesAtTheHeartsRateToAMillisecond) {
  for (const double rate : {38.0, 72.0, 133.7}) {
    Score score(rate);
    const auto times =
        timesOf(Cue::beat, played(score, 60 * runtime::kSecond, [](auto) { return running(); }));
    ASSERT_NEAR(static_cast<double>(times.size()), rate, 1) << rate;
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(static_cast<double>(times[i]) * 1e-9, static_cast<double>(i + 1) * 60 / rate,
                  1e-3)
          << rate;
  }
}

TEST(Beat, IsNotHeardWithoutAHeartNorOutsideOfARunningTrial) {
  Score heartless(std::nullopt);
  EXPECT_TRUE(played(heartless, 5 * runtime::kSecond, [](auto) { return running(); }).empty());
  Score score(72);
  EXPECT_TRUE(played(score, 5 * runtime::kSecond, [](auto) { return Seen{.trial = 1}; }).empty());
}

TEST(Beat, GoesOnAfterAPauseAsIfThereHadBeenNone) {
  Score score(60);
  const auto times = timesOf(Cue::beat, played(score, 10 * runtime::kSecond, [](std::int64_t t_ns) {
                               Seen seen = running();
                               seen.running = t_ns < 3'400'000'000 || t_ns > 6'700'000'000;
                               return seen;
                             }));
  std::vector<std::int64_t> expected;
  for (const int s : {1, 2, 3, 7, 8, 9, 10}) expected.push_back(s * runtime::kSecond);
  EXPECT_EQ(times, expected);
}

TEST(Beat, ThatIsNoticedTooLateIsLeftOut) {
  Score score(60);
  score.next(running(), 0);
  const auto starts = score.next(running(), 3'020'000'000);  // a hitch: two are long past
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts.front(), (CueStart{Cue::beat, 3 * runtime::kSecond}));
  EXPECT_TRUE(score.next(running(), 4'060'000'000).empty());
}

/// A syringe that fills by `rate` a second from `from` to `to`, in seconds.
Seen filling(std::int64_t t_ns, double from, double to, double rate) {
  Seen seen = running();
  seen.blood = rate * (std::clamp(1e-9 * static_cast<double>(t_ns), from, to) - from);
  return seen;
}

TEST(Blood, OfAVeinIsHeardOnceAFlash) {
  Score score(std::nullopt);
  const auto starts = played(score, 8 * runtime::kSecond,
                             [](std::int64_t t_ns) { return filling(t_ns, 1, 3, 0.1); });
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts.front().cue, Cue::blood);
  EXPECT_NEAR(static_cast<double>(starts.front().t_ns), 1e9, static_cast<double>(kStep_ns));
}

TEST(Blood, ComesAgainAfterASecondWithoutIt) {
  Score score(std::nullopt);
  const auto starts = played(score, 8 * runtime::kSecond, [](std::int64_t t_ns) {
    Seen seen = filling(t_ns, 1, 2, 0.1);
    seen.blood += filling(t_ns, 4, 5, 0.1).blood;
    return seen;
  });
  EXPECT_EQ(timesOf(Cue::blood, starts).size(), 2u);
}

TEST(Blood, OfAnArteryIsOneFlashThoughItRestsBetweenItsBeats) {
  Score score(std::nullopt);
  const auto starts = played(score, 6 * runtime::kSecond, [](std::int64_t t_ns) {
    constexpr double kPeriod_s = 60. / 72;
    const double t_s = 1e-9 * static_cast<double>(t_ns);
    Seen seen = running();
    seen.arterial = true;
    seen.blood = 0.1 * std::floor(t_s / kPeriod_s);  // harder than a real one: it stands, and leaps
    return seen;
  });
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts.front().cue, Cue::arterial_blood);
}

TEST(Blood, IsHeardAgainWhereItBecomesAnArterys) {
  Score score(std::nullopt);
  const auto starts = played(score, 4 * runtime::kSecond, [](std::int64_t t_ns) {
    Seen seen = filling(t_ns, 0.5, 4, 0.1);
    seen.arterial = t_ns > 2 * runtime::kSecond && t_ns < 3 * runtime::kSecond;
    return seen;
  });
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_EQ(starts[0].cue, Cue::blood);
  EXPECT_EQ(starts[1].cue, Cue::arterial_blood);
}

TEST(Blood, OfTheNextTrialIsNews) {
  Score score(std::nullopt);
  const auto starts = played(score, 3 * runtime::kSecond, [](std::int64_t t_ns) {
    Seen seen = running();
    seen.trial = t_ns < runtime::kSecond ? 1 : 2;
    seen.blood = t_ns < runtime::kSecond ? 0.5 : 0.3;  // less than in the one before
    return seen;
  });
  EXPECT_EQ(timesOf(Cue::blood, starts), (std::vector<std::int64_t>{0, runtime::kSecond}));
}

TEST(Alarm, ComesWithTheStepThatSeesItsReasonAndEvery15Seconds) {
  Score score(std::nullopt);
  const auto starts = played(score, 40 * runtime::kSecond, [](std::int64_t t_ns) {
    Seen seen = running();
    if (t_ns >= runtime::kSecond) seen.urgency = Urgency::high;
    return seen;
  });
  EXPECT_EQ(timesOf(Cue::alarm, starts),
            (std::vector<std::int64_t>{1'000'000'000, 16'000'000'000, 31'000'000'000}));
  EXPECT_EQ(starts.size(), 3u);
}

TEST(Alarm, RisesFromAWarningAtOnceAndDoesNotFallBackToOne) {
  Score score(std::nullopt);
  const auto starts = played(score, 20 * runtime::kSecond, [](std::int64_t t_ns) {
    Seen seen = running();
    seen.urgency = t_ns < 2 * runtime::kSecond || t_ns > 4 * runtime::kSecond ? Urgency::medium
                                                                              : Urgency::high;
    return seen;
  });
  ASSERT_EQ(starts.size(), 3u);
  EXPECT_EQ(starts[0], (CueStart{Cue::warning, 0}));
  EXPECT_EQ(starts[1], (CueStart{Cue::alarm, 2 * runtime::kSecond}));
  EXPECT_EQ(starts[2], (CueStart{Cue::alarm, 17 * runtime::kSecond}));
}

TEST(Alarm, ComesAnewWhenItsReasonDoes) {
  Score score(std::nullopt);
  const auto starts = played(score, 4 * runtime::kSecond, [](std::int64_t t_ns) {
    Seen seen = running();
    if (t_ns / runtime::kSecond % 2 == 0) seen.urgency = Urgency::medium;
    return seen;
  });
  EXPECT_EQ(timesOf(Cue::warning, starts).size(), 3u);
}

TEST(Score, IsSilentWhereNothingHappens) {
  Score score(std::nullopt);
  EXPECT_TRUE(played(score, 60 * runtime::kSecond, [](auto) { return running(); }).empty());
}

}  // namespace
}  // namespace palpa::sound
