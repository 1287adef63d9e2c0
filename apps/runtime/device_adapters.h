#pragma once

#include <algorithm>
#include <atomic>

#include "apps/runtime/channels.h"
#include "haptics/device.h"
#include "haptics/loop/workspace_correction.h"
#include "haptics/safety/safety_limiter.h"
#include "haptics/sensors/force_sensor.h"

namespace palpa::runtime {

/// A haptic device whose readings and commands cross to another activity (a driver's thread, the
/// virtual bench, the mouse): the tick only exchanges latest values with it. The other side is the
/// haptic loop's watchdog: where the loop has not commanded for `command_life_ns`, the force is
/// zero.
class ChannelDevice final : public haptics::HapticDevice {
 public:
  ChannelDevice(haptics::DeviceCapabilities capabilities, TimeMode mode,
                std::int64_t command_life_ns = haptics::SafetyLimits{}.watchdog_ns)
      : capabilities_(std::move(capabilities)),
        command_life_ns_(command_life_ns),
        readings_(mode),
        commands_(mode) {}

  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::DeviceReading read(std::int64_t now_ns) noexcept override {
    const haptics::DeviceReading* reading = readings_.read(now_ns);
    return reading ? *reading : haptics::DeviceReading{};
  }
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override {
    commands_.publish({now_ns, f_D}, now_ns);
  }

  /// The other side's ends.
  void publish(const haptics::DeviceReading& reading, std::int64_t now_ns) {
    readings_.publish(reading, now_ns);
  }
  Packed3 commanded(std::int64_t now_ns) {
    const Command* command = commands_.read(now_ns);
    if (!command) return {0, 0, 0};
    const bool overdue = now_ns - command->t_ns > command_life_ns_;
    if (overdue && !overdue_) timeouts_.fetch_add(1, std::memory_order_relaxed);
    overdue_ = overdue;
    return overdue ? Packed3{0, 0, 0} : command->f_D;
  }

  /// How often the loop let a command grow too old; any thread may ask.
  std::uint64_t timeouts() const noexcept { return timeouts_.load(std::memory_order_relaxed); }

 private:
  struct Command {
    std::int64_t t_ns = 0;
    Packed3 f_D{0, 0, 0};
  };
  haptics::DeviceCapabilities capabilities_;
  const std::int64_t command_life_ns_;
  StateChannel<haptics::DeviceReading> readings_;
  StateChannel<Command> commands_;
  bool overdue_ = false;  // the other side's
  std::atomic<std::uint64_t> timeouts_{0};
};

/// A force sensor whose samples cross from another activity (the virtual bench): latest wins. Older
/// than `silent_ns`: kSilent.
class ChannelSensor final : public haptics::ForceSensor {
 public:
  ChannelSensor(haptics::ForceSensorCapabilities capabilities, TimeMode mode,
                std::int64_t silent_ns = 10'000'000)
      : capabilities_(std::move(capabilities)), silent_ns_(silent_ns), samples_(mode) {}
  const haptics::ForceSensorCapabilities& capabilities() const override { return capabilities_; }
  haptics::WrenchSample read(std::int64_t now_ns) noexcept override {
    haptics::WrenchSample sample;
    sample.flags = haptics::kNothingYet;
    if (const haptics::WrenchSample* latest = samples_.read(now_ns)) {
      sample = *latest;
      if (now_ns - sample.t_ns > silent_ns_) sample.flags |= haptics::kSilent;
    }
    return sample;
  }
  void publish(const haptics::WrenchSample& sample, std::int64_t now_ns) {
    samples_.publish(sample, now_ns);
  }

 private:
  haptics::ForceSensorCapabilities capabilities_;
  const std::int64_t silent_ns_;
  StateChannel<haptics::WrenchSample> samples_;
};

/// A device whose workspace was calibrated: its readings are put right before anything else sees
/// them, so that what is recorded is what was used.
class CorrectedDevice final : public haptics::HapticDevice {
 public:
  CorrectedDevice(haptics::HapticDevice& device, const haptics::WorkspaceCorrection& correction)
      : device_(device), correction_(correction) {}
  const haptics::DeviceCapabilities& capabilities() const override {
    return device_.capabilities();
  }
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override {
    device_.command(now_ns, f_D);
  }
  haptics::DeviceReading read(std::int64_t now_ns) noexcept override {
    haptics::DeviceReading reading = device_.read(now_ns);
    reading.p_DE = haptics::corrected(correction_, reading.p_DE);
    return reading;
  }

 private:
  haptics::HapticDevice& device_;
  const haptics::WorkspaceCorrection correction_;
};

/// A device without a syringe: while the button is held the plunger is drawn, released it goes
/// back, a stroke a second. Everything else is the device's own. Called by the haptic loop alone.
class ButtonPlunger final : public haptics::HapticDevice {
 public:
  /// `button`: bits of DeviceReading::buttons; 0: the device's own plunger.
  ButtonPlunger(haptics::HapticDevice& device, std::uint32_t button)
      : device_(device), button_(button) {}
  const haptics::DeviceCapabilities& capabilities() const override {
    return device_.capabilities();
  }
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override {
    device_.command(now_ns, f_D);
  }
  haptics::DeviceReading read(std::int64_t now_ns) noexcept override {
    haptics::DeviceReading reading = device_.read(now_ns);
    if (button_ == 0) return reading;
    const double passed_s =
        last_ns_ < 0 ? 0 : std::clamp(1e-9 * static_cast<double>(now_ns - last_ns_), 0.0, 0.1);
    last_ns_ = now_ns;
    drawn_ = std::clamp(drawn_ + (reading.buttons & button_ ? passed_s : -passed_s), 0.0, 1.0);
    reading.plunger = drawn_;
    return reading;
  }

 private:
  haptics::HapticDevice& device_;
  const std::uint32_t button_;
  double drawn_ = 0;
  std::int64_t last_ns_ = -1;
};

}  // namespace palpa::runtime
