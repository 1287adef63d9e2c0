#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace palpa::bench {

/// Picture `i` of a series without any board of ours: noise of fine and coarse grain, lines of
/// text, sheets of tags of other families, and random cells in black squares, which look most like
/// tags; in turn.
cv::Mat falsePicture(int i, cv::Size size, std::uint64_t seed);

}  // namespace palpa::bench
