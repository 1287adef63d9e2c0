#pragma once

#include <vector>

#include "haptics/device.h"

namespace palpa::haptics {

/// What the loop read from a device in one of its ticks.
struct RecordedReading {
  std::int64_t t_ns = 0;  ///< session time of the tick
  DeviceReading reading;
};

/// Plays a recorded hand: the reading of the newest recorded tick whose time has come, the last one
/// from then on (which the loop takes for a silent device). Forces go nowhere: the hand does what
/// it did.
class ReplayDevice final : public HapticDevice {
 public:
  /// Throws UsageError when there is nothing to play, or times go back.
  ReplayDevice(DeviceCapabilities capabilities, std::vector<RecordedReading> readings);
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  DeviceReading read(std::int64_t now_ns) noexcept override;
  void command(std::int64_t, const Packed3&) noexcept override {}

 private:
  DeviceCapabilities capabilities_;
  std::vector<RecordedReading> readings_;
};

}  // namespace palpa::haptics
