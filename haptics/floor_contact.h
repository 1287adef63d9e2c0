#pragma once

#include <type_traits>

#include "haptics/contact_parts.h"
#include "haptics/surface/floor.h"

namespace palpa::haptics {

struct FloorGains {
  double stiffness = 5250;  ///< N/m
  double damping = 20;      ///< N s/m
};

/// How a floor is rendered. Source of interaction and gains: Edmunds and Pai, Perceptually
/// augmented simulator design (2012).
struct FloorRendering {
  FloorGains real, degraded{1050, 4};
  double unit = 60e-6;  ///< m in the hand for one U
  double weight_N = 0;  ///< of the handle, held up by the device
  double hold_stiffness = 500,
         hold_force_N = 1;   ///< N/m, at most N: how the handle is held before an episode
  double start_height = 20;  ///< U over the floor's middle, where it is held
};
static_assert(std::is_trivially_copyable_v<FloorRendering>);

struct FloorState {
  PointMotion motion;  ///< of the tip, in D
  std::uint8_t touching = 0;
  std::uint8_t reserved[7]{};
};
static_assert(std::is_trivially_copyable_v<FloorState>);

/// Where the probe is on the floor, for the record and for the augmentations.
struct FloorTouch {
  Vec3 f_F = Vec3::Zero();  ///< N, of the floor on the probe
  Vec3 p_U = Vec3::Zero();  ///< the probe, in F, U
  Vec3 v_F = Vec3::Zero();  ///< m/s
  double penetration = 0;   ///< m
  bool touching = false;
  SearchSurface::Place place;
};

/// PD control toward the closest free point c, as long as the probe p is not free:
///   f = K (c - p) - B v_n u,   u = (c - p) / |c - p|, never pulling
/// No friction: the damping acts across the surface only. K in N/m, at most the coupling's.
FloorTouch touchFloor(const SearchSurface& surface, const FloorGains& gains, double stiffest,
                      double unit, const Vec3& p_F, const Vec3& v_F) noexcept;

/// Bits of FlightRecord::place.
enum FloorPlace : std::uint8_t {
  kPlaceElement = 3,  ///< 0: none; else element + 1
  kPlaceTexture = 4,
  kPlacePit = 8,
  kPlaceTouching = 16
};
std::uint8_t placeBits(const FloorTouch& touch) noexcept;

}  // namespace palpa::haptics
