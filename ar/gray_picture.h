#pragma once

#include <opencv2/core.hpp>

namespace palpa::ar {

/// The picture as 8-bit gray, without a copy when it is gray already. Throws Error when it is empty
/// or neither 8-bit gray nor 8-bit BGR.
cv::Mat grayPicture(const cv::Mat& image);

}  // namespace palpa::ar
