#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ar/boards/board.h"

namespace palpa::ar {

/// A board on white paper as what it is: black rectangles. W's origin in the middle, +x right and
/// +y up; metres. Rectangles may touch and overlap.
struct Sheet {
  struct Black {
    double left = 0, bottom = 0, width = 0, height = 0;
  };
  std::string what;                                ///< "tag grid", for messages
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  ///< with its white margin
  double smallest = 0;                             ///< the narrowest thing that must be told apart
  std::vector<Black> black;
};

Sheet sheetOf(const TagGridSpec& spec);
/// Of any board that makeBoard knows.
Sheet sheetOf(const std::string& spec);

/// Each pixel holds the exact share of white in its square: crisp where edges fall on whole pixels,
/// and true to the geometry where they do not. Black that overlaps black counts once a pixel is
/// full. 8-bit gray. Throws UsageError beyond 30000 pixels or where the smallest thing gets less
/// than one.
cv::Mat pictureOf(const Sheet& sheet, double px_per_m);

}  // namespace palpa::ar
