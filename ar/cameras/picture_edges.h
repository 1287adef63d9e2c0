#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace palpa::ar {

/// The clear edges of a picture (picture_look.h), one entry each.
struct ClearEdges {
  std::vector<double> sigma, step;                  ///< px, gray levels
  std::array<std::vector<double>, 3> bright, dark;  ///< red, green, blue beside it, of 255

  double blur_px() const;  ///< the median of those that are high
};

/// Of 8-bit gray or BGR and the same in gray, in this part of it; at most one in 16 x 16 pixels.
ClearEdges clearEdges(const cv::Mat& picture, const cv::Mat& gray, const cv::Rect& where);

}  // namespace palpa::ar
