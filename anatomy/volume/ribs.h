#pragma once

#include "anatomy/volume/thorax_bones.h"

namespace palpa::anatomy {

/// Pieces of ribs put together and named. A piece is a rod round its lung, from the spine forward;
/// rods whose ends face each other over at most 30 mm are one rib, and the gap is bridged. Ribs
/// that begin at the spine are counted there from above ("rib_1_left": the first that was found),
/// others are "rib_piece_1_left". Crumbs are dropped.
void addRibs(const Scan& scan, const Mask& ribs, const std::vector<LabelledOrgan>& lungs,
             double midline_x, std::vector<LabelledOrgan>* organs);

}  // namespace palpa::anatomy
