#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/runtime/device_activity.h"
#include "apps/runtime/haptic_activity.h"
#include "scripted_station.h"
#include "tests/haptics/needle_bench.h"
#include "tests/runtime/activities.h"

/// A Falcon's thread, the haptic loop and a block of tissue in virtual time: what a session has.
namespace palpa::runtime {
namespace {

constexpr std::int64_t kMs = kMillisecond;

/// The grip 1 mm deep in tissue whose skin is the plane z = centre + 1 mm; needle along -z.
struct Session {
  Session() {
    haptics::TickConfig config;
    config.materials = haptics::NeedleBench{}.materials;
    config.X_ET.q = {0, 1, 0, 0};  // the needle points down; the device does not turn
    haptic = std::make_unique<HapticActivity>(bus, station.rig.driver, config);
    geometry_now.number = 0;
    station.rig.holdGripAt(haptics::kFalconCentre + Vec3(0, 0, 0.004));
    executive->add(falcon, {0, false, false});
    executive->add(*haptic, {1, true, false});
    executive->add(world, {2, false, false});
  }
  void runUntil(std::int64_t t_ns) {
    end_ns = t_ns;
    executive->run();
  }
  /// The last tick that the loop has told; `pushed`: of all since the last call.
  const haptics::FlightRecord& tick() {
    haptics::FlightRecord record;
    pushed = jumps = 0;
    while (bus.haptic_to_task.pop(&record)) {
      last = record;
      pushed += record.f_command_D[2] > 0.02;
      jumps += record.safety == haptics::SafetyCause::jump;
      most = std::max(most, unpack(record.f_command_D).norm());
    }
    return last;
  }
  std::vector<std::string> notices() {
    std::vector<std::string> all;
    for (Event event; bus.device_to_task.pop(&event);) all.push_back(event.text);
    return all;
  }

  test::Station station;
  std::unique_ptr<Executive> executive = makeVirtualExecutive();
  Bus bus{TimeMode::virtual_time};
  DriverActivity falcon{station.rig.driver, bus.device_to_task};
  std::unique_ptr<HapticActivity> haptic;
  std::int64_t end_ns = 0;
  LocalGeometry geometry_now = haptics::NeedleBench{}.geometry;
  haptics::FlightRecord last;
  Doing world{
      "world", [this](std::int64_t now) {
        haptics::TickCommands commands;
        commands.armed = commands.trial = 1;
        bus.task_to_haptic.publish(commands, now);
        geometry_now.number += 1;
        geometry_now.t_ns = now;
        geometry_now.skin.p = {0, 0, haptics::kFalconCentre.z() + 0.001};
        // The grip goes in and out once a second: 3 mm above the skin to 1 mm under it.
        const double turn = 2 * std::numbers::pi * 1e-9 * static_cast<double>(now);
        station.rig.holdGripAt(haptics::kFalconCentre + Vec3(0, 0, 0.002 + 0.002 * std::cos(turn)));
        bus.geometry_to_haptic.publish(geometry_now, now);
        haptics::FlightRecord record;
        while (bus.haptic_to_recorder.pop(&record)) {
          pushed_unhomed += !record.reading.homed && record.f_command_D != Packed3{0, 0, 0};
        }
        for (Keyframe keyframe; bus.keyframes_to_recorder.pop(&keyframe);) {
        }
        if (now >= end_ns) executive->stop();
        return now + 5 * kMs;
      }};
  int pushed_unhomed = 0, pushed = 0, jumps = 0;
  double most = 0;
};

TEST(FalconLoop, NoForceUntilHomedThenTheTissuesForce) {
  Session s;
  s.runUntil(20 * kMs);
  EXPECT_FALSE(s.falcon.mayPush());
  EXPECT_EQ(s.tick().f_command_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(s.last.safety, haptics::SafetyCause::not_ready);
  s.station.twin.startFirmware();
  s.runUntil(5'500 * kMs);  // deepest
  EXPECT_EQ(s.last.reading.homed, 0u);
  s.tick();
  ASSERT_EQ(s.last.reading.homed, 1u);
  EXPECT_NEAR(s.last.f_command_D[2], s.last.skin_force, 1e-12);
  EXPECT_GT(s.last.skin_force, 0.02);
  EXPECT_EQ(s.pushed_unhomed, 0);
  EXPECT_EQ(s.jumps, 0) << "homing is no jump";
  const std::vector<std::string> told = s.notices();
  ASSERT_FALSE(told.empty());
  EXPECT_NE(told.front().find("Falcon"), std::string::npos) << "what to do";
  EXPECT_EQ(told.back(), "") << "and that all is well";
}

TEST(FalconLoop, UnpluggedInMidSessionTheForceGoesAndComesBack) {
  Session s;
  s.station.twin.startFirmware();
  s.runUntil(4'500 * kMs);
  s.tick();
  ASSERT_GT(s.pushed, 0);
  s.notices();
  EXPECT_TRUE(s.falcon.mayPush());
  s.station.usb.unplug();
  const std::int64_t pulled = s.end_ns;
  s.runUntil(pulled + 30 * kMs);
  EXPECT_EQ(s.tick().f_command_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(s.last.safety, haptics::SafetyCause::not_ready);
  ASSERT_FALSE(s.notices().empty());
  EXPECT_FALSE(s.falcon.mayPush());
  s.station.twin.powerOff();  // it forgets firmware and homing
  s.station.usb.plugged = true;
  s.runUntil(pulled + 20'000 * kMs);
  s.most = 0;
  s.tick();
  EXPECT_GT(s.pushed, 0) << haptics::name(s.last.safety);
  EXPECT_LT(s.most, 0.5) << "no kick when it comes back, deep or not";
  EXPECT_EQ(s.pushed_unhomed, 0);
}

TEST(FalconLoop, AfterTheSessionTheLastPacketIsZero) {
  Session s;
  s.station.twin.startFirmware();
  s.runUntil(4'500 * kMs);  // deepest: it ends in contact
  ASSERT_GT(s.tick().f_command_D[2], 0.02);
  EXPECT_FALSE(s.station.rig.lastCommand().pushes());
  EXPECT_EQ(s.station.rig.state(), haptics::DriverState::closed);
}

}  // namespace
}  // namespace palpa::runtime
