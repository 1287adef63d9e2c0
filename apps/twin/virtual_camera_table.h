#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "ar/board.h"

namespace palpa::twin::picture {

inline constexpr double kPaper = 222;  ///< gray level of white paper under even light

/// A table with mild structure and the printed board in its middle, seen from above: 8-bit gray, +x
/// right, +y up, W's origin at the exact centre, `texel` metres a pixel. The structure fades to an
/// even tone toward the borders, so the table may be continued by its border pixels.
cv::Mat drawTable(const ar::TagGridSpec& board, double texel, std::uint64_t seed);

/// The same table without a board.
cv::Mat drawBareTable(const ar::TagGridSpec& board, double texel, std::uint64_t seed);

/// The printed sheet alone: as the board on the table, nothing round it.
cv::Mat drawSheet(const ar::TagGridSpec& board, double texel);

/// A wall across the line of sight, with the table's tone and structure and no end: one pixel a
/// ray (x, y, 1), `depth` metres away.
cv::Mat drawWall(const cv::Mat& ray_x, const cv::Mat& ray_y, double depth, std::uint64_t seed);

/// Width and height of that table, metres: the sheet and room around it.
Eigen::Vector2d tableSize(const ar::TagGridSpec& board);

}  // namespace palpa::twin::picture
