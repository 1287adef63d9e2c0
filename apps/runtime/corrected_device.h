#pragma once

#include "haptics/device.h"
#include "haptics/workspace_correction.h"

namespace palpa::runtime {

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

}  // namespace palpa::runtime
