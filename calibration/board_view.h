#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::calibration {

/// A picture of a flat board: its corners on the board (frame W, z = 0, m) and in the picture (px),
/// in the same order. A part of the board's corners is enough.
struct BoardView {
  std::string name;  ///< for messages, usually the file
  std::vector<Vec3> p_W;
  std::vector<Eigen::Vector2d> pixels;
};

/// Throws Error (in `where`), with the view's name, for lists of unlike length, fewer than 8
/// corners, figures that are none, a board that is not flat, corners on one line, and views whose
/// boards differ (most of their corners are none of the others').
void requireBoardViews(const std::vector<BoardView>& views, const std::string& where);

}  // namespace palpa::calibration
