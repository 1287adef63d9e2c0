#pragma once

#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "haptics/surface/floor.h"

namespace palpa::task_search {

/// The antisymmetric Gabor filter of a direction t = 2 pi direction / 32 and sigma = 2^scale px,
/// L1-normalised:
///   g = exp(-(x'^2 + gamma^2 y'^2) / (2 sigma^2)) cos(2 pi x'/lambda + pi/2)
///   x' = x cos t + y sin t,   y' = -x sin t + y cos t,   lambda = 4 sigma,   gamma = 0.5
/// cut off at 4 sigma / gamma. Rows: y. Float; an odd number of pixels a side. Source: Edmunds and
/// Pai, Perceptually augmented simulator design (2012).
cv::Mat gaborKernel(int direction, int scale);

/// Heights of pixels' middles over a square floor around the origin; rows: y. Float.
using HeightField = std::function<double(double x, double y)>;
cv::Mat heightMap(const HeightField& height, int size, double side);

/// The convolution (not the correlation) of a map with a filter, by Fourier's transform; beyond its
/// border the map is 0. Positive where the surface rises in the filter's direction.
cv::Mat filtered(const cv::Mat& map, const cv::Mat& kernel);

/// All 160 responses of a map, each against `share` of the largest response that its scale has
/// anywhere. Half of them are computed: the opposite direction's is the negative.
haptics::GaborTable riseTable(const cv::Mat& map, double side, double share);

/// How valleys are looked for; lengths in U.
struct ValleySearch {
  double side = 240;
  double seeds = 0.5;   ///< from seed to seed of the grid that is looked over
  double step = 0.05;   ///< of the central differences
  double widest = 10;   ///< largest radius of curvature that still counts as a valley
  double apart = 0.25;  ///< of the points that are kept, about
};

/// Points of a surface's valleys, found from nothing but its heights: with the gradient g and the
/// Hessian H by central differences, and e the eigenvector of H's largest eigenvalue k,
///   g . e = 0,   k >= 1 / widest
/// (the slope is zero along the most concave direction; by Newton's method along e). Where both
/// eigenvalues are alike it is a pit: g = 0, and no direction. Radius: 1 / k.
std::vector<haptics::ValleyPoint> valleyPoints(const HeightField& height,
                                               const ValleySearch& search);

}  // namespace palpa::task_search
