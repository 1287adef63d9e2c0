#pragma once

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// How a picture lies on the parametric skin (frame B, mm). The angle about the body's long axis, x
/// = 0, y = 66, and the height, with both sides mirror images, so that there is no seam and the
/// mesh keeps its shared vertices:
///
///     u = |atan2(x, 66 - y)| / pi     0 on the front's midline, 1 on the back's
///     v = (top - z) / (top - bottom)  0 at the crown, 1 at the lower cut
///
/// Sets `uvs`.
void layPicture(TriangleMesh* skin_B_mm);

/// Where each point of such a picture lies on the body: `|x|`, y, z (mm), row by row from the top.
/// Where the surface passes a place more than once (arm before chest) its outermost layer counts;
/// gaps get their neighbours'.
struct SkinMap {
  int width = 0, height = 0;
  std::vector<std::array<float, 3>> points;
};
SkinMap mapOfSkin(const TriangleMesh& skin_B_mm, int width, int height);

}  // namespace palpa::anatomy
