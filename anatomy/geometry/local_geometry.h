#pragma once

#include <cstdint>
#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa {

/// A surface near the tool, as a height over a tangent plane: point p + a x + b y + h(a, b) n, with
///   h(a, b) = sum of c_ij a^i b^j, i + j <= 3      in the order 1 a b aa ab bb aaa aab abb bbb
/// within `reach` of p; beyond, it goes on straight. Curvature is in it, so that a hand which has
/// moved since the patch was made still meets the surface. Metres; x, y, n right-handed, n outward.
struct SurfacePatch {
  static constexpr int kTerms = 10;
  Packed3 p{}, x{1, 0, 0}, n{0, 0, 1};
  double c[kTerms]{};
  double reach = 0;  ///< 0: there is no patch
};
static_assert(std::is_trivially_copyable_v<SurfacePatch>);

struct PatchContact {
  Vec3 foot = Vec3::Zero();     ///< nearest point of the surface
  Vec3 normal = Vec3::UnitZ();  ///< of the surface there, outward, unit
  double distance = 0;          ///< signed: negative inside
};

/// Nearest point of the patch to `p`, by Newton's method from the point straight below: exact to
/// micrometres within the reach while `p` is nearer than the radius of curvature. A handful of
/// multiplications: the cost knows no mesh.
PatchContact nearestOn(const SurfacePatch& patch, const Vec3& p) noexcept;

}  // namespace palpa

/// What the haptic tick knows of the world: simple shapes that agree with the meshes near the tool.
/// Made by the geometry activity at 60 Hz or more, read at 1 kHz. Everything is expressed in the
/// haptic device's base frame D, metres.
namespace palpa {

/// Anatomical structure, as the score and the report name it.
enum class Organ : std::uint8_t {
  none,
  skin,
  muscle,
  clavicle,
  rib,
  sternum,
  lung,
  vein,
  artery,
  fascia,  ///< of the muscle: a wall between fat and muscle, no mesh of its own
  scapula,
  cartilage,
  airway,
  spine,
  inclusion  ///< what a phantom hides in its silicone, to be felt
};
inline constexpr int kOrganCount = 15;

/// Hard to the needle. Cartilage of the ribs in an adult is firm enough to stop it.
constexpr bool isBone(Organ organ) {
  return organ == Organ::clavicle || organ == Organ::rib || organ == Organ::sternum ||
         organ == Organ::scapula || organ == Organ::cartilage || organ == Organ::spine;
}

/// Material that the needle tip moves through; mechanical constants are looked up by it.
enum class Tissue : std::uint8_t {
  air,
  skin,
  fat,
  muscle,
  connective,
  vein_lumen,
  artery_lumen,
  lung,
  bone
};
inline constexpr int kTissueCount = 9;

const char* name(Organ organ);
const char* name(Tissue tissue);
Organ organFromName(const char* text);  ///< Organ::none when unknown

/// Bone as capsules: all points within `radius` of a segment a–b (a = b: a sphere). Capsules with
/// the same `bone` are a chain that stands for one bone.
struct Capsule {
  Packed3 a{}, b{};
  double radius = 0;
  Organ organ = Organ::none;
  std::uint8_t bone = 0;
  std::uint8_t reserved[6]{};
};

/// A tissue boundary crossed by the (extended) needle axis, as a plane. `n` points back toward the
/// side the needle comes from. Walls (`wall` != none) must be punctured before the tip is past
/// them.
struct Boundary {
  Packed3 p{};
  Packed3 n{0, 0, 1};
  Tissue from = Tissue::air;
  Tissue to = Tissue::air;
  /// organ whose wall this is: fascia, vein, artery, lung; none: no wall
  Organ wall = Organ::none;
  bool leaving = false;  ///< true for the back wall
};

struct LocalGeometry {
  static constexpr int kMaxBones = 16;
  static constexpr int kMaxBoundaries = 16;

  std::uint64_t number = 0;  ///< 0: nothing has arrived yet
  std::int64_t t_ns = 0;     ///< when the tool was where this was made for
  SurfacePatch skin;         ///< round the entry once the skin is punctured, else round the tool
  std::int32_t bone_count = 0;
  std::int32_t boundary_count = 0;
  Capsule bones[kMaxBones];             ///< a bone's chain lies together
  Boundary boundaries[kMaxBoundaries];  ///< ordered from the skin inward
};
static_assert(std::is_trivially_copyable_v<LocalGeometry>);

}  // namespace palpa
