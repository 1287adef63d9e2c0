#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"
#include "haptics/device.h"

namespace palpa::haptics {

/// What the loop read from a device in one of its ticks.
struct RecordedReading {
  std::int64_t t_ns = 0;  ///< session time of the tick
  DeviceReading reading;
  friend bool operator<(const RecordedReading& a, const RecordedReading& b) noexcept {
    return a.t_ns < b.t_ns;
  }
};

/// Plays a recorded hand: the reading of the newest recorded tick whose time has come, the last one
/// from then on (which the loop takes for a silent device). Forces go nowhere: the hand does what
/// it did.
class ReplayDevice final : public HapticDevice {
 public:
  /// Throws UsageError when there is nothing to play, or times go back.
  ReplayDevice(DeviceCapabilities capabilities, std::vector<RecordedReading> readings)
      : capabilities_(std::move(capabilities)), readings_(std::move(readings)) {
    if (readings_.empty())
      throw UsageError("holds no readings", "replay of a device",
                       "Choose a session in which a trial was run");
    if (!std::is_sorted(readings_.begin(), readings_.end()))
      throw UsageError("has times that go back", "replay of a device", "Choose another session");
  }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  DeviceReading read(std::int64_t now_ns) noexcept override {
    const auto after =
        std::upper_bound(readings_.begin(), readings_.end(), RecordedReading{now_ns, {}});
    return after == readings_.begin() ? DeviceReading{} : std::prev(after)->reading;
  }
  void command(std::int64_t, const Packed3&) noexcept override {}

 private:
  DeviceCapabilities capabilities_;
  std::vector<RecordedReading> readings_;
};

}  // namespace palpa::haptics
