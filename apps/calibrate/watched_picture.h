#pragma once

#include <filesystem>
#include <vector>

#include "apps/runtime/clock.h"
#include "ar/boards/board.h"
#include "ar/cameras/camera.h"
#include "calibration/camera_calibration.h"

namespace palpa::cli {

/// Keeps in a JPEG what the camera of a calibration sees, for whoever looks on: at most five
/// pictures a second. Parts of the picture in which the board has been seen well are tinted, its
/// points of the last view ringed. Never in the way: a picture that cannot be written is left out.
class WatchedPicture {
 public:
  explicit WatchedPicture(std::filesystem::path file) : file_(std::move(file)) {}
  void see(const ar::Frame& frame);
  void covered(const std::vector<ar::BoardPoint>& points, const calibration::CoverageMap& coverage);

 private:
  void write() const;

  const std::filesystem::path file_;
  const runtime::SteadyClock clock_;
  std::int64_t next_ns_ = 0;
  cv::Mat last_;
  std::vector<ar::BoardPoint> points_;
  calibration::CoverageMap coverage_{};
};

}  // namespace palpa::cli
