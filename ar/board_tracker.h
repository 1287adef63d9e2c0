#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "ar/board.h"
#include "ar/board_pose.h"

namespace palpa::ar {

/// Finds one board in picture after picture: first around where it was, and in the whole picture
/// whenever that shows fewer points than before. A board of a single tag is therefore the one that was found
/// first for as long as it is seen, also beside a larger one. Not for several threads at once.
class BoardTracker {
 public:
  BoardTracker(const Board& board, const calibration::CameraModel& camera);

  /// Pose of the board in this picture; nothing where it is not seen.
  std::optional<BoardPose> see(const cv::Mat& image);

  /// Where the board is looked for first, pixels; empty: everywhere.
  const cv::Rect& region() const { return region_; }

 private:
  std::vector<BoardPoint> detect(const cv::Mat& image);

  const Board& board_;
  calibration::CameraModel camera_;
  cv::Rect region_;
  std::size_t seen_ = 0;
};

}  // namespace palpa::ar
