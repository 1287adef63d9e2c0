#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

/// What is wrong with a sample (bits of WrenchSample::flags); 0: nothing.
enum WrenchFlag : std::uint32_t {
  kNothingYet = 1u << 0,  ///< no sample has arrived; force and torque are zero
  kSilent = 1u << 1,      ///< the newest sample is older than the sensor allows
  kFault = 1u << 2,       ///< the sensor reports a fault: `status` is not 0
  kSaturated = 1u << 3,   ///< the sensor reports saturated gauges: the values mean nothing
  kOverload = 1u << 4,    ///< a component is at or beyond the stated range
};
/// Flags of samples that are not used. An overload is used: it is large, if not exact.
inline constexpr std::uint32_t kUnusable = kNothingYet | kSilent | kFault | kSaturated;

/// One sample of a force sensor, as measured: with bias, tool weight and noise in it.
/// S: sensor frame. Force and torque are what the tool exerts on the sensor, about the origin of S.
struct WrenchSample {
  std::int64_t t_ns = 0;          ///< session time of arrival
  std::uint64_t sequence = 0;     ///< grows with every new sample
  Packed3 f_S{0, 0, 0};           ///< N
  Packed3 tau_S{0, 0, 0};         ///< N m
  std::uint32_t ft_sequence = 0;  ///< the sensor's own sample counter, as sent
  std::uint32_t status = 0;       ///< the sensor's own status word; 0 is good
  std::uint32_t flags = 0;        ///< WrenchFlag bits
  std::uint32_t reserved = 0;
};
static_assert(std::is_trivially_copyable_v<WrenchSample>);

/// What a force sensor can do. SI units; a range of 0 is unknown and raises no overload.
struct ForceSensorCapabilities {
  std::string name;
  Packed3 max_force_N{0, 0, 0};  ///< x, y, z of S
  Packed3 max_torque_Nm{0, 0, 0};
  double force_resolution = 0;   ///< N
  double torque_resolution = 0;  ///< N m
  double rate_Hz = 0;            ///< samples a second
  bool simulated = false;
};

/// kOverload when a component of `sample` is at or beyond its range, else 0.
std::uint32_t overloadFlag(const ForceSensorCapabilities& range,
                           const WrenchSample& sample) noexcept;

/// A force/torque sensor: real driver, virtual twin or replay. `read` is called from the haptic
/// thread: it takes the latest value and never blocks, allocates, locks or throws.
class ForceSensor {
 public:
  virtual ~ForceSensor() = default;
  virtual const ForceSensorCapabilities& capabilities() const = 0;
  virtual WrenchSample read(std::int64_t now_ns) noexcept = 0;
};

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
