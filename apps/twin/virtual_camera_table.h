#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "ar/board.h"

namespace palpa::twin::picture {

/// A table with mild structure and the printed board in its middle, seen from above: 8-bit gray, +x
/// right, +y up, W's origin at the exact centre, `texel` metres a pixel. The structure fades to an
/// even tone toward the borders, so the table may be continued by its border pixels.
cv::Mat drawTable(const ar::TagGridSpec& board, double texel, std::uint64_t seed);

/// Width and height of that table, metres: the sheet and room around it.
Eigen::Vector2d tableSize(const ar::TagGridSpec& board);

}  // namespace palpa::twin::picture
