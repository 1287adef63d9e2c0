#pragma once

#include "anatomy/parametric/build.h"

namespace palpa::anatomy {

/// The skin's tone of a person, sRGB 0..1: seed 0 a middling light one, others drawn evenly between
/// very light and dark brown.
std::array<float, 3> skinTone(std::uint64_t seed);

/// What the skin of head and trunk looks like, on the coordinates that `layPicture` has laid over
/// its mesh (frame B, mm): tone, mottling, pores, redder cheeks and lips, areolae, brows and closed
/// lids; a mannequin's, not a portrait. The same seed gives the same bytes.
Texture paintSkin(const TriangleMesh& skin_B_mm, const Build& build, std::uint64_t seed);

}  // namespace palpa::anatomy
