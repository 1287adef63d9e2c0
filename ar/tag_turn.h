#pragma once

#include <vector>

#include "ar/board.h"

namespace palpa::ar {

/// A tag of a grid with its corners in W, numbered as its pixels are.
struct PlacedTag {
  Tag tag;
  std::array<Vec3, 4> corners_W;
};

/// Tags of one sheet, printed turned by the same unknown number of quarter turns: the tags with
/// corners in W after the turn that fits. A turn fits a pair of tags if the homography of either
/// one puts the other's middle where it is seen, to within half their distance (a wrong turn errs
/// by 1.4 distances or more, and no lens bends that much). The turn with the most such pairs wins;
/// a tag that fits less than half of the others is left out. Empty where fewer than two tags
/// remain.
std::vector<PlacedTag> placeTags(const std::vector<Tag>& tags, const TagGridSpec& spec);

}  // namespace palpa::ar
