#pragma once

#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::assess {

/// Something that belongs there and is felt in every case, such as the edge of a liver: a line
/// along the top, as broad as `width`. P, m. It is no lump, and is not to be marked.
struct NormalAnatomy {
  std::string name;
  std::vector<Vec3> line_P;
  double width = 0;
};

/// m along the top from the middle of the line; infinite where it has no points.
double fromLine(const NormalAnatomy& anatomy, const Vec3& p_P);

/// What a place lies on, to within `reach` of its breadth; nullptr: on nothing of it.
const NormalAnatomy* anatomyAt(const std::vector<NormalAnatomy>& all, const Vec3& p_P,
                               double reach);

}  // namespace palpa::assess
