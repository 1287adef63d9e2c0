#pragma once

#include <array>
#include <type_traits>

#include "haptics/modulation/touch_augmentation.h"

/// What a second tool presses on a real object with that is tracked but carries no force sensor,
/// like a finger of the other hand: from the first tool's reaction, both places, and the object's
/// law. An estimate, never a measurement.
namespace palpa::haptics {

/// Which face of the object the second tool presses.
struct SecondFace {
  bool opposed = false;  ///< from below, the face opposite the first tool's
  double thickness = 0;  ///< m, from face to face; of use where it is opposed
};

inline constexpr double kEstimateSmooth_s = 0.015,  ///< of a tracker's places [chosen]
    kFacePlacedWithin = 1e-3,                       ///< m, before it is touched [chosen]
    kEstimateForceDoubt = 0.025,                    ///< N [chosen], as of a squeeze
    kEstimateDepthDoubt = 0.05;                     ///< of a depth that the law tells [chosen]

struct EstimateState {
  double level = 0;      ///< m, of the undeformed face along z, as the first tool's reaction has it
  double precision = 0;  ///< 1/m^2, inverse variance of it; 0: nothing is known yet
  Packed3 p_M{};         ///< m, of the second tool, smoothed
  DahlState friction;
  std::uint32_t held = 0;  ///< p_M is there
  std::uint32_t reserved = 0;
};
static_assert(std::is_trivially_copyable_v<EstimateState>);

struct EstimatedReaction {
  Vec3 p_M = Vec3::Zero(), f_r = Vec3::Zero();  ///< m, N: of one time
  double x = 0;                                 ///< m, how deep it presses
};

/// Frame P of the object, faces z = 0 and z = -thickness; `first` with its sensed reaction, `p_M`
/// of the second: middles of round tips of radius r. With the first pressed along n = z,
///     x_1 = x0 + H^-1(f_r1 . n, 0)                        by its reaction
/// beside each other on one face, which does not move:
///     level = mean of (p_M1.z - r) + x_1                  over all ticks since the first touched,
///     weighted by 1/((0.025 N / H'(x))^2 + (0.05 x)^2), and of 0 within 1 mm
///     x_2 = level - (p_M2.z - r)
/// opposite each other, where the object between them may move as a whole (10.15 with unequal
/// depths):
///     x_2 = thickness - (p_M1.z - r) + (p_M2.z + r) - x_1,   without the first's touch from rest
///     f_r2 = H(x_2 - x0, 0) n_2 - drag                    n_2 = z, opposite -z; Dahl's friction
/// Rates are left out: a tracker's differences are noise. p_M2 is smoothed with 15 ms. Zero below
/// the law's least contact and for invalid figures. `laws`: the object's under the first tool and
/// under the second. No allocation, no exception.
EstimatedReaction estimateReaction(const std::array<StiffnessModulation, 2>& laws,
                                   const SecondFace& face, double tip_radius,
                                   const ToolTouch& first, const Vec3& p_M, double dt,
                                   EstimateState* state) noexcept;

}  // namespace palpa::haptics
