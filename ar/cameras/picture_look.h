#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

namespace palpa::ar {

/// What a camera has made of what it saw. Levels and grain in parts of the brightest that the
/// picture can hold; channels red, green, blue.
struct PictureLook {
  double blur_px = 0;                      ///< sigma of a Gaussian, pixel and lens together
  std::array<double, 3> black{}, white{};  ///< what is on the two sides of the clearest edges
  std::array<double, 5> grain{};           ///< standard deviation of a pixel, from black to white
  double grain_neighbours = 0;             ///< correlation of a pixel's grain with that of the next
  double grain_colour = 0;                 ///< 0: alike in all channels; 1: each has its own
};

/// From one picture alone, 8-bit gray or BGR; nothing where it does not show enough clear edges and
/// even places. `where`: whose edges count (empty, or too few there: all); a lens is not as sharp
/// at every distance. Throws Error for any other kind of picture.
///
/// Blur: around the steepest edges, pixels against their distance d from the edge,
///     I(d) = low + (high - low) Phi((d - m) / sigma)
/// by Gauss-Newton over low, high, m, sigma and the edge's direction; the median of those that fit
/// and are high: black print on white paper, and not a shadow or something soft.
///
/// Grain: in blocks of 8 x 8 without structure, what remains beside a plane; its variance over
/// brightness. By a sensor alone that is a line (Healey, Kondepudy 1994: a part of the reading, a
/// part of the light); what is kept as JPEG has less in the dark, and none where it is saturated.
std::optional<PictureLook> lookOf(const cv::Mat& picture, const cv::Rect& where = {});

}  // namespace palpa::ar
