#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace palpa::ar {

/// The picture as 8-bit gray, without a copy when it is gray already. Throws Error when it is empty
/// or neither 8-bit gray nor 8-bit BGR.
cv::Mat grayPicture(const cv::Mat& image);

/// Whether two edges cross at `pixel` of an 8-bit gray picture: black in two opposite quarters
/// round it and white in the other two, by 15 gray levels at least and about as much on both sides.
/// The quarters are looked at where `x` and `y`, pixels along the edges, lead together; black are
/// the two where both have the same sign.
bool isCrossing(const cv::Mat& gray, const Eigen::Vector2d& pixel, const Eigen::Vector2d& x,
                const Eigen::Vector2d& y);

/// Pixels that a step from `p` covers, both in a plane that `H` takes to the picture.
Eigen::Vector2d stepInPicture(const cv::Matx33d& H, const Eigen::Vector2d& p,
                              const Eigen::Vector2d& step);

/// Moves a pixel to the point where two edges cross; false, and the pixel left alone, where none is
/// near. `room`: pixels to the next edge that is not one of the two; the window (0.9 of it each
/// way, 2 to 15) keeps clear of it however it is turned. Saddle points are not moved by blur.
bool refineSaddle(const cv::Mat& gray, double room, Eigen::Vector2d* pixel);

/// The smaller of the two heights of a quadrilateral, taken for a parallelogram: what a steep view
/// leaves of its side.
double outlineHeight(const std::vector<cv::Point2f>& corners);

}  // namespace palpa::ar
