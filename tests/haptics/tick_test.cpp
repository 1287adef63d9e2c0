#include "haptics/loop/tick.h"

#include <gtest/gtest.h>

#include <cstring>

#include "needle_bench.h"
#include "tests/support/allocation_guard.h"

namespace palpa::haptics {
namespace {

struct Loop {
  TickConfig config;
  TickState state;
  TickCommands commands;
  DeviceReading reading;
  LocalGeometry geometry = NeedleBench{}.geometry;
  std::int64_t now = 0;
  bool refresh = true;  // a new snapshot every 16 ms
  Loop() {
    config.materials = NeedleBench{}.materials;
    config.X_ET.p = {0, 0, 0.11};
    commands.armed = 1;
    commands.trial = 1;
    reading.homed = 1;
    reading.q_DE = {0, 1, 0, 0};  // needle down
  }
  FlightRecord step(double depth) {
    now += 1'000'000;
    ++reading.sequence;
    reading.p_DE = {0, 0, 0.11 - depth};
    geometry.t_ns = now;
    if (refresh && state.tick % 16 == 0) ++geometry.number;
    return tick(config, state, reading, &geometry, commands, now);
  }
  FlightRecord go(double from, double to) {
    FlightRecord last;
    const double step_m = (to > from ? 1e-5 : -1e-5);
    for (double d = from; (to - d) * step_m > 0; d += step_m) last = step(d);
    return last;
  }
};

TEST(Tick, NeverAllocates) {
  Loop loop;
  loop.step(0);
  const NoAllocation guard;
  loop.refresh = false;
  for (double d = 0; d < 0.03; d += 2e-5) {
    loop.geometry.number += static_cast<std::uint64_t>(static_cast<int>(d * 1e5) % 17 == 0);
    loop.step(d);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(Tick, ForceFeedbackOffComputesTheSameForce) {
  Loop on, off;
  off.commands.force_feedback = 0;
  for (double d = 0; d < 0.01; d += 1e-5) {
    const FlightRecord a = on.step(d), b = off.step(d);
    ASSERT_EQ(a.f_contact_D, b.f_contact_D);
    ASSERT_EQ(b.f_command_D, (Packed3{0, 0, 0}));
  }
}

TEST(Tick, ASnapshotRefreshIsNotFelt) {
  Loop loop;
  loop.config.safety.max_slew_N_per_s = 1e9;
  loop.go(0, 0.0022);
  loop.refresh = false;
  for (int i = 0; i < 20; ++i) loop.step(0.0022);  // the last blend is over
  const double before = loop.step(0.0022).f_contact_D[2];
  ++loop.geometry.number;
  for (auto* p : {&loop.geometry.skin.p}) (*p)[2] += 0.0001;  // the new plane lies 0.1 mm higher
  double last = before, largest = 0, final = 0;
  for (int i = 0; i < 30; ++i) {
    final = loop.step(0.0022).f_contact_D[2];
    largest = std::max(largest, std::abs(final - last));
    last = final;
  }
  EXPECT_GT(final - before, 0.05);              // the refresh matters ...
  EXPECT_LT(largest, 0.15 * (final - before));  // ... and comes in ten steps
}

TEST(Tick, AStaleSnapshotFadesToZeroWithinTheStatedTime) {
  Loop loop;
  loop.go(0, 0.0022);
  ASSERT_GT(unpack(loop.step(0.0022).f_command_D).norm(), 0.2);
  const std::int64_t t0 = loop.state.now.t_ns;
  FlightRecord r;
  bool tripped = false;
  while (loop.now < t0 + loop.config.age_limit_ns + loop.config.fade_ns) {
    loop.now += 1'000'000;
    ++loop.reading.sequence;
    r = tick(loop.config, loop.state, loop.reading, nullptr, loop.commands, loop.now);
    tripped = tripped || ((r.events & kSafetyTripped) && r.safety == SafetyCause::stale_geometry);
    if (loop.now < t0 + loop.config.age_limit_ns) {
      ASSERT_GT(unpack(r.f_command_D).norm(), 0.2);
    }
  }
  EXPECT_TRUE(tripped);
  EXPECT_EQ(r.f_command_D, (Packed3{0, 0, 0}));
}

TEST(Tick, ANotFiniteReadingGivesZeroAndDoesNotPoisonTheState) {
  Loop loop;
  loop.go(0, 0.0022);
  DeviceReading good = loop.reading;
  loop.reading.p_DE[1] = std::numeric_limits<double>::quiet_NaN();
  loop.now += 1'000'000;
  FlightRecord r =
      tick(loop.config, loop.state, loop.reading, &loop.geometry, loop.commands, loop.now);
  EXPECT_EQ(r.f_command_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(r.safety, SafetyCause::not_finite);
  loop.reading = good;
  for (int i = 0; i < 20; ++i) r = loop.step(0.0022);
  EXPECT_GT(unpack(r.f_command_D).norm(), 0.2);
}

TEST(Tick, APauseOfTheLoopIsRecordedAsWatchdogAndTakesTheForceOnce) {
  Loop loop;
  loop.go(0, 0.0022);
  ASSERT_GT(unpack(loop.step(0.0022).f_command_D).norm(), 0.2);
  loop.now += 9'000'000;  // and 1 ms more in step(): the limit itself
  FlightRecord r = loop.step(0.0022);
  EXPECT_NE(r.safety, SafetyCause::watchdog);
  EXPECT_GT(unpack(r.f_command_D).norm(), 0.2);
  loop.now += 9'000'001;
  r = loop.step(0.0022);
  EXPECT_EQ(r.safety, SafetyCause::watchdog);
  EXPECT_TRUE(r.events & kSafetyTripped);
  EXPECT_EQ(r.f_command_D, (Packed3{0, 0, 0}));
  r = loop.step(0.0022);
  EXPECT_TRUE(r.events & kSafetyCleared);
  EXPECT_GT(unpack(r.f_command_D).norm(), 0.2);
}

TEST(Tick, ADamagedSnapshotIsRefusedOnceAndTheLastSoundOneFades) {
  Loop loop;
  loop.go(0, 0.0022);
  loop.refresh = false;
  for (int i = 0; i < 30; ++i) loop.step(0.0022);
  const std::uint64_t sound = loop.state.now.number;
  loop.geometry.number = sound + 1;
  loop.geometry.boundary_count = 1000;
  FlightRecord r = loop.step(0.0022);
  EXPECT_TRUE(r.events & kSnapshotRefused);
  EXPECT_EQ(r.snapshot, sound + 1) << "so that it can be run again";
  EXPECT_GT(unpack(r.f_command_D).norm(), 0.2);
  for (int i = 0; i < 150; ++i) {
    r = loop.step(0.0022);
    ASSERT_FALSE(r.events & kSnapshotRefused);
    ASSERT_EQ(r.snapshot, sound);
  }
  EXPECT_EQ(r.f_command_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(r.safety, SafetyCause::corrupt_geometry);
  loop.geometry.boundary_count = 5;
  ++loop.geometry.number;
  loop.step(0.0022);
  EXPECT_EQ(loop.state.now.number, sound + 2);
}

TEST(Tick, SameInputsSameBitsAlsoFromAKeyframe) {
  Loop a;
  a.go(0, 0.004);
  Loop b = a;  // a keyframe: the whole state copied
  for (double d = 0.004; d < 0.02; d += 1e-5) {
    const FlightRecord ra = a.step(d), rb = b.step(d);
    ASSERT_EQ(std::memcmp(&ra.f_contact_D, &rb.f_contact_D, sizeof ra.f_contact_D), 0);
    ASSERT_EQ(std::memcmp(&ra.f_command_D, &rb.f_command_D, sizeof ra.f_command_D), 0);
    ASSERT_EQ(ra.events, rb.events);
  }
}

TEST(Tick, ANewTrialStartsFresh) {
  Loop loop;
  loop.go(0, 0.01);
  ASSERT_EQ(loop.state.contact.phase, NeedlePhase::inserted);
  loop.commands.trial = 2;
  EXPECT_NE(loop.step(-0.01).phase, NeedlePhase::inserted);
  EXPECT_EQ(loop.state.contact.skin_punctures, 0);
}

TEST(Tick, NoForceWhenNotHomedOrNotArmed) {
  Loop loop;
  loop.go(0, 0.0022);
  loop.reading.homed = 0;
  EXPECT_EQ(loop.step(0.0022).f_command_D, (Packed3{0, 0, 0}));
  loop.reading.homed = 1;
  loop.commands.armed = 0;
  EXPECT_EQ(loop.step(0.0022).f_command_D, (Packed3{0, 0, 0}));
}

}  // namespace
}  // namespace palpa::haptics
