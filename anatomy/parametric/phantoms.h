#pragma once

#include <optional>
#include <string>

#include "anatomy/geometry/top_shape.h"
#include "anatomy/patient.h"

/// A block of silicone on a table, flat on top or shaped as a part of a body is, to be palpated
/// from above, as a patient who lies on the back:
/// its top faces -y of A. Frame P of the block: the origin in the middle of its top, x to the right
/// and y away from who palpates, z up. x_A = x_P, y_A = -z_P, z_A = y_P. Metres.
namespace palpa::anatomy {

namespace landmark {
/// middle of the top's edge toward who palpates: from there it is looked at
inline constexpr const char* kNearEdge = "near_edge";
}  // namespace landmark

inline constexpr double kBlockEdge = 0.004;  ///< m, radius of the edges

Pose X_AP();

/// `size`: along x, y, z of P; its height below the origin. One closed skin and landmarks; for no
/// needle. Its top is that of `top`, drawn down or up with all below it in proportion, to the flat
/// base. Throws Error for what is no block: a side shorter than 10 mm or longer than 2 m, a top
/// that comes within 5 mm of the base.
Patient phantomBlock(const Vec3& size, const std::string& name, const TopShape& top = {});

}  // namespace palpa::anatomy

/// Training phantoms of silicone, as parts of a patient's body to be palpated: they lie on a flat
/// base (y = 0), the side to be palpated toward -y, the origin in the middle of the base. Metres.
/// What they hide is an `Organ::inclusion`.
namespace palpa::anatomy {

enum class PhantomKind { breast, abdomen };

/// Breast: a sphere. Abdomen: an enlarged liver below the right costal margin, so thick a diameter
/// above its rounded edge (within 20 %).
struct PhantomInclusion {
  double diameter = 0.020;
  double depth = 0.015;     ///< of silicone over it, along the skin's normal
  double left = 0, up = 0;  ///< breast: x and z of the point of the skin that it lies under
};

struct PhantomSpec {
  PhantomKind kind = PhantomKind::breast;
  std::optional<PhantomInclusion> inclusion;
};

namespace landmark {
/// abdomen: on the middle of the liver's edge
inline constexpr const char* kInclusion = "inclusion_centre";
inline constexpr const char* kInclusionSkin = "inclusion_skin";  ///< on the skin over it
}  // namespace landmark

/// Breast: a dome of 120 mm diameter and 45 mm height. Abdomen: a gently domed slab of 260 x 200 x
/// 80 mm with an umbilicus. Closed surfaces; `checkPatient` and the needle task are not for them.
/// Throws Error where the inclusion does not fit: at least 2 mm of silicone (or its depth) are to
/// stay all round.
Patient buildPhantom(const PhantomSpec& spec);

}  // namespace palpa::anatomy
