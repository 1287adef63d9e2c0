#pragma once

#include <functional>
#include <opencv2/core.hpp>

#include "haptics/surface/gabor_table.h"

namespace palpa::task_search {

/// The antisymmetric Gabor filter of a direction t = 2 pi direction / 32 and sigma = 2^scale px,
/// L1-normalised:
///   g = exp(-(x'^2 + gamma^2 y'^2) / (2 sigma^2)) cos(2 pi x'/lambda + pi/2),   x' = x cos t + y
///   sin t,  y' = -x sin t + y cos t,   lambda = 4 sigma,  gamma = 0.5
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

}  // namespace palpa::task_search
