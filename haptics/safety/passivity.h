#pragma once

#include <type_traits>

#include "anatomy/geometry/pose.h"
#include "haptics/device.h"

namespace palpa::haptics {

/// Time-domain passivity control (Hannaford and Ryu 2002, with the prediction of Ryu et al. 2004),
/// at one port, force held for a period:
///   observer     E += -f_last . dx     energy the hand has put in, J
///   prediction   E' = E - f . dx       the next period, if the hand goes on like this
///   controller   E' < -e:  f -= a v,  a = min((-E' - e) / (T |v|^2), a_max)     e: nobody feels it
///   bounds       E <= |f| reach: more than a spring with this force can hold was dissipated, and
///                is no credit for later; a debt is forgotten slowly
/// Where `f` is zero nothing is damped: a hand in free air is not braked for what a contact owes,
/// which is paid in the next one.
/// `f` is the force on the hand at the port that must not make energy. A cue that heeds no motion
/// is a source, bounded by its plan: it may give its work away, and no more than that. Its force is
/// left out of `f` and so of the account, which is owed nothing by it and owes it nothing.
/// Without a new reading the hand has not been seen to move: what was added stays added, and the
/// time goes to the next reading's step, so that a loop faster than its device is as safe as one in
/// step with it. Where a real object is felt, that is the hand's port (object and device together),
/// so that taking stiffness or friction away from the object is not mistaken for instability.
struct PassivityLimits {
  double max_damping = 0;  ///< N s/m; 0.2 m / T keeps an injection of a mass m stable; 0: off
  /// e; a spring of 1 kN/m pressed 3 mm in a second makes 5 uJ by being sampled
  double unfelt_J = 20e-6;
  double forget_tau = 2;  ///< s, for debts
  double reach = 0.02;    ///< m: half the deepest elastic contact
  /// N: friction of the drives, which swallows encoder steps' make-believe energy
  double coulomb = 0;
};

struct PassivityState {
  Packed3 f_last_D{};  ///< of the port, held since the last tick
  Packed3 p_last_D{};
  double energy_J = 0;         ///< negative: made by us
  double reserved_J = 0;       ///< recorded states keep their places
  Packed3 added_D{};           ///< damping force, held until the next reading
  double since_s = 0;          ///< since the last new reading
  std::uint64_t sequence = 0;  ///< of that reading, as the tick counts them
  std::uint8_t started = 0;
  std::uint8_t injecting = 0;  ///< damping was added in this tick
  std::uint8_t reserved[6]{};
};
static_assert(std::is_trivially_copyable_v<PassivityState>);

struct PassivityInput {
  Vec3 p_DE = Vec3::Zero();
  Vec3 f_D = Vec3::Zero();  ///< that the device shall give
  /// of a real object on the hand; zero where nothing real is touched
  Vec3 f_object_D = Vec3::Zero();
  Vec3 f_source_D = Vec3::Zero();  ///< the part of `f_D` that heeds no motion
  double dt = 0.001;
  bool fresh = true;  ///< p_DE is a new reading
};

/// Returns the force with the damping that keeps the port passive. Never allocates, never throws.
Vec3 keepPassive(const PassivityLimits& limits, PassivityState& state,
                 const PassivityInput& input) noexcept;

/// The lightest grip that must not make the device shake: a loose pen grip, 2 N s/m.
inline constexpr double kLightestGrip = 2;

/// Largest stiffness that a device can render with the period T (s) and the virtual damping B
/// (N s/m):
///   K <= (b - |B|) / (T/2 + t_d)   b: damping of device and hand (Colgate and Schenkel 1997),
///                                  t_d: the device's delay
///   K <= 2 f_c / Delta             f_c: Coulomb friction, Delta: encoder step (Abbott and Okamura
///                                  2005); where both are known
///   K <= what its maker or a measurement says is stable, where known
/// At least 0. Throws nothing; a device without any data gets 0.
double couplingStiffness(const DeviceCapabilities& device, double period_s,
                         double virtual_damping = 0, double grip_damping = kLightestGrip) noexcept;

}  // namespace palpa::haptics
