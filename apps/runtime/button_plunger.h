#pragma once

#include <algorithm>

#include "haptics/device.h"

namespace palpa::runtime {

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
