#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace palpa::ar {

/// White paper, W's origin in its middle, +x right and +y up, to be printed black. Each pixel holds
/// the exact share of white in its square: crisp where edges fall on whole pixels, and true to the
/// geometry where they do not. Black that overlaps black counts once a pixel is full.
class Paper {
 public:
  /// `size` in metres. Throws UsageError beyond 30000 pixels or where `smallest` (metres), the
  /// narrowest thing that must be told apart, gets less than a pixel. `what`: named in the error.
  Paper(const Eigen::Vector2d& size, double px_per_m, double smallest, const char* what);

  /// Blackens the rectangle from (left, bottom) to (left + width, bottom + height), metres.
  void blacken(double left, double bottom, double width, double height);
  cv::Mat picture() const;  ///< 8-bit gray

 private:
  double px_per_m_;
  cv::Mat share_;  ///< of black, float
};

}  // namespace palpa::ar
