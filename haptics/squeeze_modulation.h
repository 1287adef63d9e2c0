#pragma once

#include <array>
#include <type_traits>

#include "anatomy/geometry/pose.h"
#include "haptics/stiffness_modulation.h"

/// A real object between two tools that is lifted and squeezed, and feels harder, softer, heavier
/// or lighter than it is (Jeon & Harders 2012; weight: Jeon et al. 2011).
namespace palpa::haptics {

struct SqueezeModulation {
  TargetStiffness target;      ///< per contact; a factor is of the real squeezing force
  double weight_factor = 1;    ///< of the real weight
  double least_contact = 0.1;  ///< N, of either reaction
  HuntCrossley real = {};      ///< each side as identified; k = 0: not known
};

struct SqueezeState {
  double d0 = 0;  ///< m between the tips where both begin to touch; 0: they do not
};
static_assert(std::is_trivially_copyable_v<SqueezeModulation> &&
              std::is_trivially_copyable_v<SqueezeState>);

struct Squeezed {
  bool contact = false;
  Vec3 l = Vec3::UnitX();  ///< from the second tip to the first
  double F = 0, x = 0;     ///< N, squeezing force; m, depth at each contact
  std::array<Vec3, 2> f_w{Vec3::Zero(), Vec3::Zero()};  ///< N, each tool's share of the weight
  std::array<Vec3, 2> f_d{Vec3::Zero(), Vec3::Zero()};  ///< N, of the devices on the tools
};

/// From the reactions on both tools (N, tool weights taken off) and their tips (m), no slip and no
/// inertia of the object:
///     l = (p1 - p2) / |p1 - p2|,   u_1 = l,   u_2 = -l                        outward
///     F = (f_r1 - f_r2) . l / 2                                               (10.12-10.14: equal
///     shares of the weight along l cancel) x = (d0 - |p1 - p2|) / 2 (10.15) d0 = |p1 - p2| + 2
///     H^-1(F, 0)   at the first tick beyond `least_contact`: a soft thing is some millimetres deep
///     by then f_w* = f_r* - F u_* f_d* = (k~ x - F) u_* + (weight factor - 1) f_w* (10.11)
/// Which tool is the first does not matter. Zero where one of them does not touch, or for figures
/// that are none. No allocation, no exception.
Squeezed modulateSqueeze(const SqueezeModulation& law, const std::array<Vec3, 2>& f_r,
                         const std::array<Vec3, 2>& p, SqueezeState* state) noexcept;

}  // namespace palpa::haptics
