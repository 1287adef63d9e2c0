#pragma once

#include <array>
#include <cstdint>
#include <variant>

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/geometry_activity.h"
#include "haptics/device.h"
#include "haptics/flight_record.h"
#include "haptics/loop/tick_config.h"
#include "haptics/loop/tick_state.h"
#include "haptics/sensors/reaction_filter.h"
#include "haptics/sensors/wrench_filter.h"
#include "haptics/surface/floor.h"

namespace palpa::runtime {

/// Floors by number, asked for by the haptic thread: what is given stays as it is while a tick may
/// name its number.
class FloorSource {
 public:
  virtual ~FloorSource() = default;
  /// Null: there is none (yet). Neither waits nor allocates.
  virtual const haptics::Floor* floor(std::uint32_t number) const noexcept = 0;
};

/// Of a force sensor on the tool.
struct ForceSensingSetup {
  /// A low-pass at the loop's rate, its motion at the device's; or a Kalman filter at the device's.
  /// K: the tool's tip, or a round tip's middle
  std::variant<haptics::WrenchFilter, haptics::ReactionFilter> filter;
  Pose X_WD = Pose::Identity();  ///< which way is down
  Pose X_ES = Pose::Identity();  ///< the sensor on the end effector
};

/// A force sensor on the tool, read in the haptic thread: its newest sample, cleared of bias, tool
/// and noise, as the force of a real object on the tool, in D. The tool's motion is that of the
/// device's readings at their own times, however often the loop asks; unusable until the device is
/// homed. Between readings the Kalman filter looks ahead; after a gap in them until the motion is
/// known again the last force holds, but no longer than `kGoodFor_ns` and only while the sensor
/// itself is well. Never allocates, never throws.
class ForceSensing {
 public:
  static constexpr std::int64_t kGoodFor_ns = 10'000'000;  ///< as old as a sample may be

  ForceSensing(haptics::ForceSensor& sensor, const ForceSensingSetup& setup)
      : sensor_(sensor), setup_(setup) {}

  haptics::SensedForce sense(const haptics::DeviceReading& reading, std::int64_t now_ns) noexcept;

 private:
  /// What touches the tool, by whichever filter.
  struct Touch {
    Vec3 f_W;
    Packed3 p_WK;
    bool valid = false;  ///< known at this very tick
    bool well = false;   ///< of the sensor
  };
  /// Times: of the reading, and now.
  Touch touched(const haptics::WrenchFilter& filter, const haptics::WrenchSample& sample,
                const Pose& X_WS, std::int64_t t_ns, std::int64_t now_ns) noexcept;
  Touch touched(const haptics::ReactionFilter& filter, const haptics::WrenchSample& sample,
                const Pose& X_WS, std::int64_t t_ns, std::int64_t now_ns) noexcept;

  haptics::ForceSensor& sensor_;
  ForceSensingSetup setup_;
  haptics::WrenchFilterState low_passed_;
  haptics::ReactionState predicted_;
  std::int64_t stepped_ns_ = 0;  // when that last saw a new reading
  haptics::SensedForce last_;    // valid
  std::int64_t last_ns_ = -kGoodFor_ns - 1;
};

/// What a recorded tick alone tells of the tool at X_DT: no speed, no point of entry.
ToolState toolStateOf(const PackedPose& X_DT, const haptics::FlightRecord& record);
/// What the slower activities are told of a tool after a tick.
ToolState toolStateOf(const haptics::TickConfig& config, const haptics::TickState& state,
                      const haptics::FlightRecord& record, std::int64_t now_ns);

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
  void publish(const haptics::FlightRecord& record, std::int64_t now_ns);
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

/// A device with the sensor on its tool; null: a tool that is only tracked.
struct SensedTool {
  haptics::HapticDevice& device;
  ForceSensing* sensing;
};

/// HAPTIC where two devices touch one real thing, every `TickConfig::period_ns` of the first: both
/// devices and their sensors -> tickPair -> both devices. Never allocates (in real time), locks,
/// logs or throws. Every tick is recorded twice, the first device's record before the second's.
class HapticPairActivity final : public Activity {
 public:
  HapticPairActivity(Bus& bus, const std::array<SensedTool, 2>& tools,
                     const haptics::PairConfig& config)
      : bus_(bus), tools_(tools), config_(config) {}
  const char* name() const override { return "haptic"; }
  std::int64_t step(std::int64_t now_ns) override;
  std::int64_t period_ns() const override { return config_.tools[0].period_ns; }

 private:
  Bus& bus_;
  std::array<SensedTool, 2> tools_;
  const haptics::PairConfig config_;
  haptics::PairState state_;
  std::int64_t due_ns_ = -1;
};

}  // namespace palpa::runtime
