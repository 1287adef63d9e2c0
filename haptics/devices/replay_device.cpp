#include "haptics/devices/replay_device.h"

#include <algorithm>

#include "anatomy/base/error.h"

namespace palpa::haptics {
namespace {
bool earlier(const RecordedReading& a, const RecordedReading& b) { return a.t_ns < b.t_ns; }
}  // namespace

ReplayDevice::ReplayDevice(DeviceCapabilities capabilities, std::vector<RecordedReading> readings)
    : capabilities_(std::move(capabilities)), readings_(std::move(readings)) {
  if (readings_.empty())
    throw UsageError("holds no readings", "replay of a device",
                     "Choose a session in which a trial was run");
  if (!std::is_sorted(readings_.begin(), readings_.end(), earlier))
    throw UsageError("has times that go back", "replay of a device", "Choose another session");
}

DeviceReading ReplayDevice::read(std::int64_t now_ns) noexcept {
  const auto after =
      std::upper_bound(readings_.begin(), readings_.end(), RecordedReading{now_ns, {}}, earlier);
  return after == readings_.begin() ? DeviceReading{} : std::prev(after)->reading;
}

}  // namespace palpa::haptics
