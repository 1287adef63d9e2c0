#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

namespace palpa::ar {

/// The grain of a picture (picture_look.h); of 255.
struct Grain {
  static constexpr int kKnots = 6;  ///< of brightness, evenly from 0 to 255
  /// Its variance at the knots; straight between them.
  std::array<double, kKnots> variance{};
  double neighbours = 0;  ///< correlation of a pixel with the next
  double colour = 0;      ///< 0: alike in all channels; 1: each its own

  double sigmaAt(double level) const;
};

/// Of 8-bit gray or BGR and the same in gray; nothing where too few places are even.
std::optional<Grain> grainOf(const cv::Mat& picture, const cv::Mat& gray);

}  // namespace palpa::ar
