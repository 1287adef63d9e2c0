#pragma once

#include <vector>

#include "haptics/sensors/force_sensor.h"

namespace palpa::haptics {

/// Plays recorded samples: the newest whose time has come, the last one from then on; before the
/// first, kNothingYet. Time may also run backwards (a replay that is wound back).
class ReplaySensor final : public ForceSensor {
 public:
  /// Throws UsageError when times go back.
  ReplaySensor(ForceSensorCapabilities capabilities, std::vector<WrenchSample> samples);
  const ForceSensorCapabilities& capabilities() const override { return capabilities_; }
  WrenchSample read(std::int64_t now_ns) noexcept override;

 private:
  ForceSensorCapabilities capabilities_;
  std::vector<WrenchSample> samples_;
};

}  // namespace palpa::haptics
