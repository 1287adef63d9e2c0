#pragma once

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/floor_source.h"
#include "apps/runtime/force_sensing.h"
#include "apps/runtime/geometry_activity.h"
#include "haptics/device.h"
#include "haptics/tick.h"

namespace palpa::runtime {

inline constexpr std::int64_t kKeyframeTicks = 200;

/// HAPTIC, every `TickConfig::period_ns` (1 to 4 kHz): device and force sensor -> tick -> device.
/// Never allocates (in real time), locks, logs or throws.
class HapticActivity final : public Activity {
 public:
  /// `sensing`: a force sensor on the tool; `exact`: geometry made anew in every tick instead of
  /// the snapshots that come (slow, and it allocates: for measuring in virtual time); `floors`:
  /// what a search explores. Null: none.
  HapticActivity(Bus& bus, haptics::HapticDevice& device, const haptics::TickConfig& config,
                 ForceSensing* sensing = nullptr, GeometryActivity* exact = nullptr,
                 const FloorSource* floors = nullptr)
      : bus_(bus),
        device_(device),
        config_(config),
        sensing_(sensing),
        exact_(exact),
        floors_(floors) {}
  const char* name() const override { return "haptic"; }
  std::int64_t step(std::int64_t now_ns) override;
  std::int64_t period_ns() const override { return config_.period_ns; }

 private:
  void tell(const haptics::FlightRecord& record, std::int64_t now_ns);
  const LocalGeometry* geometryFor(const haptics::DeviceReading& reading, std::int64_t now_ns);

  Bus& bus_;
  haptics::HapticDevice& device_;
  const haptics::TickConfig config_;
  ForceSensing* sensing_;
  GeometryActivity* exact_;
  const FloorSource* floors_;
  LocalGeometry made_;
  haptics::TickState state_;
  std::int64_t due_ns_ = -1;
};

}  // namespace palpa::runtime
