#pragma once

#include <type_traits>

#include "haptics/contact/contact_parts.h"
#include "haptics/contact/needle_contact.h"
#include "haptics/materials/force_laws.h"
#include "haptics/surface/floor.h"

namespace palpa::haptics {

/// A palpation probe on soft tissue. The tip is a ball; radius 0: a point.
struct ProbeMaterials {
  double radius = 0;       ///< m
  double stiffness = 500;  ///< k, N/m
  double damping = 0;      ///< b, N s/m
  double friction = 0;     ///< mu, Coulomb
  double shear = 300;      ///< N/m, before the tip slides
  Relaxation relaxation;   ///< of the elastic part
};
static_assert(std::is_trivially_copyable_v<ProbeMaterials>);

struct ProbeState {
  PointMotion motion;  ///< of the tip's centre
  RelaxationState relaxation;
  Packed3 anchor_D{};  ///< stick point of the tip on the surface
  Organ bone = Organ::none;
  std::uint8_t touching = 0;
  std::uint8_t reserved[6]{};
};
static_assert(std::is_trivially_copyable_v<ProbeState>);

/// One evaluation of a ball (centre p_DT, radius of the materials) against the curved skin and the
/// bones under it:
///   skin   (k x - b v_n) n, the first part relaxing, never pulling; across it stick-slip friction
///          with the limit mu f_n
///   bone   K_c x along the normal between ball and capsule
/// x: penetration, m; v_n: velocity along the outward normal. k and b in series with the coupling:
/// k <= K_c. Advances `state`. No allocation, no exception.
NeedleContact probeContact(const ProbeMaterials& materials, const CouplingLimits& coupling,
                           const LocalGeometry& geometry, const Vec3& p_DT, double dt,
                           ProbeState& state) noexcept;

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
