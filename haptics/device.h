#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

/// One reading of a haptic device. D: device base, E: end effector (gimbal centre).
struct DeviceReading {
  std::int64_t t_ns = 0;       ///< device clock mapped to the session's
  std::uint64_t sequence = 0;  ///< grows with every new reading; a silent device stops counting
  Packed3 p_DE{0, 0, 0};
  Packed4 q_DE{1, 0, 0, 0};
  double plunger = 0;  ///< drawn fraction of the syringe, 0..1
  std::uint32_t buttons = 0;
  std::uint32_t homed = 0;  ///< 1 once positions are absolute
  /// Of the hand on the tool, N, by an instrumented handle; not used by the loop, recorded
  Packed3 f_hand_D{0, 0, 0};
  /// Of the device on the tool, N, drives and friction, by a force cell before it; likewise
  Packed3 f_device_D{0, 0, 0};
  /// 1: both are measured. No device sold measures them: simulated ones do
  std::uint32_t instrumented = 0;
  std::uint32_t reserved = 0;
};
static_assert(std::is_trivially_copyable_v<DeviceReading>);

/// What takes the force away by itself when no command comes any more: the program is dead, or
/// stopped.
enum class Watchdog : std::uint8_t {
  unknown,  ///< nothing that anybody vouches for: the last force may stay
  own       ///< the device's
};

/// What a device can do; the coupling and the safety limits are sized from it. SI units.
struct DeviceCapabilities {
  std::string name;
  double max_force_N = 0;          ///< continuous
  double stable_stiffness = 0;     ///< N/m, largest wall it renders without oscillating
  double position_resolution = 0;  ///< m
  double apparent_mass = 0;        ///< kg
  double viscous_damping = 0;      ///< N s/m, of the mechanism
  double coulomb_friction = 0;     ///< N, of the drives; 0: not known
  double delay = 0;  ///< s, from a reading to the force that answers it, beyond the loop's period
  int force_axes = 3;
  bool has_orientation = true;
  Packed3 workspace_centre{0, 0, 0};     ///< in D, m
  Packed3 workspace_half_size{0, 0, 0};  ///< m; the box about the centre is reached; zero: unknown
  bool simulated = false;
  Watchdog watchdog = Watchdog::unknown;
};

/// A force-feedback device: real driver, virtual twin or replay. `read` and `command` are called
/// from the haptic thread: they exchange latest values and never block, allocate, lock or throw.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceCapabilities& capabilities() const = 0;
  virtual DeviceReading read(std::int64_t now_ns) noexcept = 0;
  virtual void command(std::int64_t now_ns, const Packed3& f_D) noexcept = 0;
};

}  // namespace palpa::haptics
