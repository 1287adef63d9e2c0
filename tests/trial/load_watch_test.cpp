#include "apps/trial/load_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace palpa::trial {
namespace {

using runtime::kMillisecond;

/// A loop of `period`, whose every `each`-th tick is late, and a task that looks 100 times a
/// second.
struct Station {
  std::int64_t period = kMillisecond, late = 0;
  int each = 1;
  double frames_a_second = 30;
  std::uint64_t waiting = 100, lost = 0;

  void run(LoadWatch& watch, double seconds) {
    const std::int64_t end = now + std::llround(1e9 * seconds);
    for (; now < end; now += period, ++tick) {
      haptics::FlightRecord record{};
      record.tick = tick;
      record.late_ns = tick % each == 0 ? late : 0;
      record.t_ns = now + record.late_ns;
      watch.tick(record);
      if (now % (10 * kMillisecond) == 0)
        watch.look({static_cast<std::uint64_t>(frames_a_second * 1e-9 * static_cast<double>(now)),
                    lost, waiting});
    }
  }
  std::int64_t now = 0;
  std::int64_t tick = 1;
};

std::string onlyVerdict(Station station) {
  LoadWatch watch;
  station.run(watch, 2.1);
  EXPECT_TRUE(watch.rehearsed());
  const auto all = watch.verdicts();
  if (all.size() != 1) return std::to_string(all.size()) + " verdicts";
  EXPECT_FALSE(all[0].remedy.empty());
  return all[0].what;
}

TEST(LoadWatch, SaysNothingOfAStationThatKeepsUp) {
  EXPECT_EQ(onlyVerdict({}), "0 verdicts");
  EXPECT_EQ(onlyVerdict({.period = kMillisecond / 4, .late = 100'000}), "0 verdicts");
  EXPECT_EQ(onlyVerdict({.late = 9 * kMillisecond, .each = 200}), "0 verdicts")
      << "one tick of 200: 99 % are in time";
}

TEST(LoadWatch, SaysWhatIsTooSlowWithItsFigure) {
  EXPECT_EQ(onlyVerdict({.late = 2'400'000, .each = 20}),
            "The haptic loop is late (99 % below 2.4 ms)");
  EXPECT_EQ(onlyVerdict({.frames_a_second = 8}), "The picture is slow (8 a second)");
  EXPECT_EQ(onlyVerdict({.waiting = 1300}), "The evidence is 1.3 s behind");
}

TEST(LoadWatch, MeasuresTheLoopByItsOwnPeriod) {
  const std::int64_t quarter = kMillisecond / 4;
  EXPECT_EQ(onlyVerdict({.period = quarter, .late = 200'000}),
            "The haptic loop is late (99 % below 0.2 ms)");
  LoadWatch watch;
  Station station{.period = quarter, .late = 300'000, .each = 100};
  station.run(watch, 1);
  EXPECT_NEAR(static_cast<double>(watch.missed()), 40, 1) << "one of 100 is later than a period";
}

TEST(LoadWatch, RehearsesTwoSecondsOfTicksAndNoMore) {
  LoadWatch watch;
  EXPECT_FALSE(watch.rehearsed());
  Station station;
  station.run(watch, 1.9);
  EXPECT_FALSE(watch.rehearsed());
  station.run(watch, 0.2);
  EXPECT_TRUE(watch.rehearsed());
  station.late = 5 * kMillisecond;
  station.run(watch, 5);
  EXPECT_TRUE(watch.verdicts().empty()) << "what comes later is the trials'";
}

TEST(LoadWatch, CountsForEachTrialWhatItSuffered) {
  LoadWatch watch;
  Station station{.late = 5 * kMillisecond, .each = 50};
  station.run(watch, 1);
  station.lost = 3;
  station.run(watch, 0.1);
  watch.beginTrial();
  EXPECT_EQ(watch.missed() + watch.lost(), 0u);
  station.lost = 10;
  station.run(watch, 1);
  EXPECT_EQ(watch.missed(), 20u);
  EXPECT_EQ(watch.lost(), 7u);
  station.late = 0;
  watch.beginTrial();
  station.run(watch, 1);
  EXPECT_EQ(watch.missed() + watch.lost(), 0u);
}

TEST(LoadWatch, OfTwoDevicesOneTellsOfATick) {
  LoadWatch watch;
  haptics::FlightRecord record{};
  for (int i = 0; i < 10; ++i) {
    record.t_ns = i * kMillisecond + 2 * kMillisecond;
    record.late_ns = 2 * kMillisecond;
    for (const std::uint8_t tool : {0, 1}) {
      record.tool = tool;
      watch.tick(record);
    }
  }
  EXPECT_EQ(watch.missed(), 10u);
}

TEST(LoadWatch, SeesOnTheBusWhatIsLostAndWhatWaits) {
  runtime::Bus bus(runtime::TimeMode::real);
  for (int i = 0; i < 8200; ++i) bus.haptic_to_recorder.push({});
  haptics::FlightRecord taken;
  bus.haptic_to_recorder.pop(&taken);
  const LoadWatch::Seen seen = LoadWatch::seenOn(bus, 7);
  EXPECT_EQ(seen.frames, 7u);
  EXPECT_EQ(seen.lost, 8u);
  EXPECT_EQ(seen.waiting, 8191u);
}

}  // namespace
}  // namespace palpa::trial
