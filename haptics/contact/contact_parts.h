#pragma once

#include <type_traits>

#include "anatomy/geometry/local_geometry.h"
#include "haptics/flight_record.h"

namespace palpa::haptics {

/// Deepest contact of the needle (a thick segment) with one bone capsule.
struct BoneContact {
  double penetration = 0;    ///< m; 0: none
  Vec3 p_D = Vec3::Zero();   ///< on the needle's axis
  Vec3 n_D = Vec3::UnitZ();  ///< from the bone to the needle, unit
  Organ organ = Organ::none;
};

/// Closest points of segments hub–tip and a–b, then penetration = radii - distance.
BoneContact bonePenetration(const Capsule& bone, const Vec3& p_hub, const Vec3& p_tip,
                            double needle_radius) noexcept;

}  // namespace palpa::haptics

/// What needle and probe have in common. Frame D, SI units; nothing allocates or throws.
namespace palpa::haptics {

struct CouplingLimits {
  double stiffness = 1000;      ///< K_c, N/m: no slope is steeper than this
  double velocity_tau = 0.005;  ///< s, low-pass of the tip's velocity (encoder steps)
};

/// A point's velocity from its positions: v += (dx/dt - v) dt / (tau + dt). Clear `started` to
/// begin at rest.
struct PointMotion {
  Packed3 p_D{};  ///< in the last tick
  Packed3 v_D{};  ///< low-passed, m/s
  std::uint8_t started = 0;
  std::uint8_t reserved[7]{};
};
static_assert(std::is_trivially_copyable_v<PointMotion>);
void follow(PointMotion& motion, const Vec3& p_D, double tau, double dt) noexcept;

/// A surface that sticks to a point until it slides: -k times the way across the normal n from the
/// anchor, at most `largest` N; the anchor follows what slides. k in N/m; 0: no friction.
Vec3 dragAcross(Packed3& anchor_D, const Vec3& p_D, const Vec3& n_D, double k,
                double largest) noexcept;

/// Contact with every bone at once, one force a bone (a chain's joints do not count twice):
/// f = K_c x penetration, along the normal from bone to tool.
struct BoneTouch {
  static constexpr int kMost = LocalGeometry::kMaxBones;
  struct One {
    Vec3 f_D, p_D;  ///< on the tool, and where
  };
  One each[kMost];
  int count = 0;
  double largest = 0;         ///< N
  Organ organ = Organ::none;  ///< of the largest
  std::uint32_t events = 0;   ///< kBoneTouched, kBoneLeft against the organ of the last tick
};
BoneTouch touchBones(const LocalGeometry& geometry, const Vec3& p_hub, const Vec3& p_tip,
                     double radius, double stiffness, Organ last) noexcept;

}  // namespace palpa::haptics
