#pragma once

#include "anatomy/parametric/build.h"
#include "anatomy/patient.h"

namespace palpa::anatomy {

/// How a picture lies on the parametric skin (frame B, mm). The angle about the body's long axis,
/// x = 0, y = 66, and the height, with both sides mirror images, so that there is no seam and the
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

/// The skin's tone of a person, sRGB 0..1: seed 0 a middling light one, others drawn evenly between
/// very light and dark brown.
std::array<float, 3> skinTone(std::uint64_t seed);

/// What the skin of head and trunk looks like, on the coordinates that `layPicture` has laid over
/// its mesh (frame B, mm): tone, mottling, pores, redder cheeks and lips, areolae, brows and closed
/// lids; a mannequin's, not a portrait. The same seed gives the same bytes.
RgbPicture paintSkin(const TriangleMesh& skin_B_mm, const Build& build, std::uint64_t seed);

}  // namespace palpa::anatomy
