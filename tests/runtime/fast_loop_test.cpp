#include <gtest/gtest.h>

#include <vector>

#include "activities.h"
#include "apps/runtime/device_adapters.h"
#include "apps/runtime/haptic_activity.h"
#include "tests/haptics/needle_bench.h"

/// The loop at 1 kHz and at 4 kHz in virtual time, on the same hand: what is counted in ticks would
/// show.
namespace palpa::runtime {
namespace {

constexpr std::int64_t kSlow = kMillisecond, kFast = kMillisecond / 4, kEnd = 800 * kMillisecond;

std::vector<haptics::FlightRecord> runLoop(std::int64_t period_ns,
                                           std::int64_t silent_from_ns = kNever,
                                           std::int64_t stale_from_ns = kNever) {
  haptics::TickConfig config;
  config.materials = haptics::NeedleBench{}.materials;
  config.X_ET.p = {0, 0, 0.11};
  config.period_ns = period_ns;
  const auto executive = makeVirtualExecutive();
  Bus bus(TimeMode::virtual_time);
  ChannelDevice device({}, TimeMode::virtual_time);
  HapticActivity haptic(bus, device, config);
  haptics::TickCommands commands;
  commands.armed = 1;
  bus.task_to_haptic.publish(commands, 0);
  std::uint64_t sequence = 0, number = 0;
  Doing hand("hand", [&](std::int64_t now) {  // 2 mm/s into the skin, short of the puncture
    haptics::DeviceReading reading;
    reading.t_ns = now;
    reading.sequence = ++sequence;
    reading.homed = 1;
    reading.q_DE = {0, 1, 0, 0};
    reading.p_DE = {0, 0, 0.11 - 0.002e-9 * static_cast<double>(now)};
    if (now < silent_from_ns) device.publish(reading, now);
    return now + kFast;
  });
  Doing geometry("geometry", [&](std::int64_t now) {
    LocalGeometry snapshot = haptics::NeedleBench{}.geometry;
    snapshot.number = ++number;
    snapshot.t_ns = now;
    if (now < stale_from_ns) bus.geometry_to_haptic.publish(snapshot, now);
    return now + 16 * kMillisecond;
  });
  std::vector<haptics::FlightRecord> records;
  Doing watch("watch", [&](std::int64_t now) {
    haptics::FlightRecord record;
    while (bus.haptic_to_task.pop(&record)) records.push_back(record);
    while (bus.haptic_to_recorder.pop(&record)) {
    }
    if (now >= kEnd) executive->stop();
    return now + 100 * kMillisecond;
  });
  executive->add(hand, {0, false, false});
  executive->add(geometry, {1, false, false});
  executive->add(haptic, {2, true, false});
  executive->add(watch, {3, false, false});
  executive->run();
  EXPECT_EQ(bus.haptic_to_recorder.overflows() + bus.haptic_to_task.overflows(), 0u);
  return records;
}

std::int64_t firstWith(const std::vector<haptics::FlightRecord>& records,
                       haptics::SafetyCause cause) {
  for (const auto& r : records)
    if (r.safety == cause && r.t_ns > 100 * kMillisecond) return r.t_ns;
  return -1;
}

TEST(FastLoop, FourTicksAMillisecondOnTheGrid) {
  const auto records = runLoop(kFast);
  ASSERT_EQ(records.size(), static_cast<std::size_t>(kEnd / kFast) + 1);
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].tick, static_cast<std::int64_t>(i));
    EXPECT_EQ(records[i].t_ns, static_cast<std::int64_t>(i) * kFast);
  }
}

TEST(FastLoop, TheForceIsThatOfTheSlowLoop) {
  const auto slow = runLoop(kSlow), fast = runLoop(kFast);
  double strongest = 0;
  for (std::size_t i = 100; i < slow.size(); ++i) {
    ASSERT_EQ(slow[i].t_ns, fast[4 * i].t_ns);
    const Vec3 f = unpack(slow[i].f_command_D), g = unpack(fast[4 * i].f_command_D);
    strongest = std::max(strongest, f.norm());
    // A millisecond of this hand is 2 um, on a coupling of 1000 N/m 2 mN: so far apart may two
    // steps be.
    EXPECT_LT((f - g).norm(), 0.002 + 0.01 * f.norm()) << slow[i].t_ns;
  }
  EXPECT_GT(strongest, 0.05) << "nothing was touched";
}

TEST(FastLoop, LimitsInTimeDoNotDependOnThePeriod) {
  constexpr std::int64_t kSilent = 501 * kMillisecond;
  for (const std::int64_t period : {kSlow, kFast}) {
    const std::int64_t last_reading = kSilent - kFast;
    const std::int64_t heard =
        last_reading / period * period + (last_reading % period ? period : 0);
    EXPECT_EQ(firstWith(runLoop(period, kSilent), haptics::SafetyCause::silent_device),
              heard + 10 * kMillisecond)
        << period;
    const auto stale =
        runLoop(period, kNever, 400 * kMillisecond);  // the last snapshot is of 384 ms
    EXPECT_EQ(firstWith(stale, haptics::SafetyCause::stale_geometry), 484 * kMillisecond + period)
        << period;
    EXPECT_EQ(stale.back().f_command_D, (Packed3{0, 0, 0})) << period;
  }
}

}  // namespace
}  // namespace palpa::runtime
