#include "apps/runtime/stop_switch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>

#include "activities.h"
#include "anatomy/base/error.h"
#include "apps/runtime/device_adapters.h"
#include "apps/runtime/haptic_activity.h"
#include "tests/haptics/needle_bench.h"
#include "tests/support/no_threads.h"

/// The emergency stop's way to the tick, whatever else hangs.
namespace palpa::runtime {
namespace {

TEST(StopSwitch, APressHoldsUntilSomebodyWhoHasSeenItReArms) {
  StopSwitch stop;
  EXPECT_FALSE(stop.noForce());
  stop.press();
  EXPECT_TRUE(stop.noForce());
  stop.rearm(1);
  EXPECT_FALSE(stop.noForce());
  const std::uint32_t seen = stop.presses();
  stop.press();
  stop.rearm(seen);
  EXPECT_TRUE(stop.noForce()) << "pressed again before the re-arming came";
  stop.rearm(stop.presses());
  stop.end();
  stop.rearm(stop.presses());
  EXPECT_TRUE(stop.noForce()) << "the session is at its end";
}

/// A needle that is pushed up to 4 mm into the skin: there is force in every tick. What the device
/// is asked first in a tick may press the switch: no tick can begin later after a press.
class PressingDevice final : public haptics::HapticDevice {
 public:
  explicit PressingDevice(StopSwitch& stop) : stop_(stop) {}
  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::DeviceReading read(std::int64_t now_ns) noexcept override {
    if (reads_.load() + 1 == press_at_.load()) stop_.press();
    haptics::DeviceReading reading;
    reading.t_ns = now_ns;
    reading.sequence = static_cast<std::uint64_t>(++reads_);
    reading.homed = 1;
    reading.q_DE = {0, 1, 0, 0};  // needle down
    const int since = reads_.load() - begun_.load();
    const double depth = std::min(0.004, 1e-5 * static_cast<double>(since) - 0.001);
    reading.p_DE = {0, 0, 0.11 - depth};
    return reading;
  }
  void command(std::int64_t, const Packed3& f_D) noexcept override { commanded_ = f_D; }
  int reads() const { return reads_.load(); }
  void pressInRead(int number) { press_at_.store(number); }
  void beginAgain() { begun_.store(reads_.load()); }  ///< from above the skin

 private:
  StopSwitch& stop_;
  haptics::DeviceCapabilities capabilities_;
  std::atomic<int> reads_{0}, press_at_{-1}, begun_{0};
  Packed3 commanded_{};
};

haptics::TickConfig needleConfig() {
  haptics::TickConfig config;
  config.materials = haptics::NeedleBench{}.materials;
  config.X_ET.p = {0, 0, 0.11};
  return config;
}

haptics::TickCommands armed() {
  haptics::TickCommands commands;
  commands.armed = commands.trial = 1;
  return commands;
}

/// The ticks since the press, of a loop in which nobody but the device and the switch lives.
struct Loop {
  explicit Loop(TimeMode mode) : bus(mode) {
    LocalGeometry geometry = haptics::NeedleBench{}.geometry;
    geometry.number = 1;
    bus.geometry_to_haptic.publish(geometry, 0);
    bus.task_to_haptic.publish(armed(), 0);
  }
  std::vector<haptics::FlightRecord> recorded() {
    std::vector<haptics::FlightRecord> all;
    for (haptics::FlightRecord record; bus.haptic_to_recorder.pop(&record);) all.push_back(record);
    return all;
  }
  Bus bus;
  PressingDevice device{bus.stop};
  HapticActivity haptic{bus, device, needleConfig()};
};

void renew(Bus& bus, std::int64_t now_ns, std::uint64_t number) {
  LocalGeometry geometry = haptics::NeedleBench{}.geometry;
  geometry.number = number;
  geometry.t_ns = now_ns;
  bus.geometry_to_haptic.publish(geometry, now_ns);
}

void expectNoForceFrom(const std::vector<haptics::FlightRecord>& ticks, std::size_t press) {
  ASSERT_GT(ticks.size(), press + 10);
  EXPECT_GT(unpack(ticks[press - 1].f_command_D).norm(), 0.1) << "nothing was to be stopped";
  for (std::size_t i = press; i < ticks.size(); ++i) {
    ASSERT_EQ(ticks[i].f_command_D, (Packed3{0, 0, 0})) << i - press << " ticks after the press";
    ASSERT_EQ(ticks[i].safety, haptics::SafetyCause::emergency_stop);
  }
}

TEST(StopSwitch, TheTickOfThePressHasNoForceAlreadyAndOnlyReArmingBringsItBack) {
  Loop loop(TimeMode::real);
  loop.device.pressInRead(401);
  std::int64_t now = 0;
  for (int i = 0; i < 450; ++i, now += kMillisecond) {
    renew(loop.bus, now, static_cast<std::uint64_t>(i + 1));
    loop.haptic.step(now);
  }
  expectNoForceFrom(loop.recorded(), 400);
  loop.bus.stop.rearm(loop.bus.stop.presses());
  for (int i = 0; i < 20; ++i, now += kMillisecond) loop.haptic.step(now);
  EXPECT_EQ(loop.recorded().back().f_command_D, (Packed3{0, 0, 0})) << "not disarmed in between";
  loop.bus.task_to_haptic.publish({}, now);
  loop.haptic.step(now += kMillisecond);
  loop.bus.task_to_haptic.publish(armed(), now);
  loop.device.beginAgain();  // what was pressed in unarmed is not felt
  for (int i = 0; i < 400; ++i, now += kMillisecond) {
    renew(loop.bus, now, static_cast<std::uint64_t>(1000 + i));
    loop.haptic.step(now);
  }
  EXPECT_GT(unpack(loop.recorded().back().f_command_D).norm(), 0.1);
}

/// Every other thread of a session hangs in a call; the loop does not notice.
TEST(StopSwitch, IsObeyedWhileEveryOtherThreadHangs) {
  Loop loop(TimeMode::real);
  std::promise<void> released;
  const std::shared_future<void> release = released.get_future().share();
  const auto executive = makeRealExecutive();
  std::atomic<int> hanging{0};
  const auto hang = [&](std::int64_t) {
    if (loop.device.reads() < 300) return executive->clock().now() + kMillisecond;
    ++hanging;
    release.wait();
    return kNever;
  };
  Doing scene("scene", hang), task("task", hang), recorder("recorder", hang),
      camera("camera", hang);
  std::uint64_t number = 1;
  Doing geometry("geometry", [&](std::int64_t now) {
    renew(loop.bus, now, ++number);
    return now + 5 * kMillisecond;
  });
  Doing watch("watch", [&](std::int64_t now) {
    if (hanging == 4 && loop.device.reads() > 600) {
      loop.device.pressInRead(loop.device.reads() + 50);
      return kNever;
    }
    return now + kMillisecond;
  });
  Doing end("end", [&](std::int64_t now) {
    if (loop.bus.stop.presses() == 0 || loop.bus.stop.presses() > 1) return now + kMillisecond;
    if (executive->stuckFor(10 * kMillisecond).size() < 4) return now + kMillisecond;
    for (const int to = loop.device.reads() + 30; loop.device.reads() < to;)
      std::this_thread::yield();
    executive->stop();
    return kNever;
  });
  for (Activity* activity : std::initializer_list<Activity*>{&loop.haptic, &scene, &task, &recorder,
                                                             &camera, &geometry, &watch, &end})
    executive->add(*activity, {0, activity == &loop.haptic, activity == &scene});
  Executive::Stuck stuck;
  executive->whenStuck(
      [&](const Executive::Stuck& names, const std::string&) {
        stuck = names;
        released.set_value();
      },
      20 * kMillisecond);
  executive->run();
  EXPECT_EQ(stuck, (Executive::Stuck{"scene", "task", "recorder", "camera"}));
  const std::vector<haptics::FlightRecord> ticks = loop.recorded();
  std::size_t press = 0;
  while (press < ticks.size() && !ticks[press].commands.emergency_stop) ++press;
  EXPECT_EQ(loop.bus.stop.presses(), 1u);
  expectNoForceFrom(ticks, press);
}

/// What cannot have its thread ends them all, in words; nothing of it was begun.
TEST(RealExecutive, WithoutThreadsItEndsInWords) {
  const auto executive = makeRealExecutive();
  int steps = 0;
  const auto count = [&](std::int64_t now) { return ++steps, now + kMillisecond; };
  Doing camera("camera", count), scene("scene", count);
  executive->add(camera, {0, false, false});
  executive->add(scene, {0, false, true});
  const test::NoThreads none;
  EXPECT_THROW(executive->run(), Error);
  EXPECT_EQ(steps, 0);
}

TEST(RealExecutive, NothingIsGivenUpThatEndsInTime) {
  const auto executive = makeRealExecutive();
  int steps = 0, given_up = 0;
  Doing scene("scene",
              [&](std::int64_t now) { return ++steps == 20 ? kNever : now + kMillisecond; });
  executive->add(scene, {0, false, true});
  executive->whenStuck([&](const Executive::Stuck&, const std::string&) { ++given_up; }, kSecond);
  executive->run();
  EXPECT_EQ(steps, 20);
  EXPECT_EQ(given_up, 0);
  EXPECT_TRUE(executive->stuckFor(0).empty());
}

}  // namespace
}  // namespace palpa::runtime
