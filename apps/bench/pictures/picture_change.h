#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace palpa::bench {

/// Mean of the channels.
float brightness(const cv::Vec3f& rgb);

/// What has changed from one picture to another of the same view, in levels, at places between
/// pixels. RGB, softened against grain.
class PictureChange {
 public:
  static constexpr float kChanged = 9;  ///< beyond grain

  PictureChange(const cv::Mat3b& before, const cv::Mat3b& now);

  cv::Vec3f now(const Eigen::Vector2d& p) const;
  cv::Vec3f at(const Eigen::Vector2d& p) const;  ///< now, less before
  float size(const Eigen::Vector2d& p) const;    ///< of the channel that changed most
  float lighter(const Eigen::Vector2d& p) const;
  /// Red and blue over green, to the whole, more than before: as the hub is in any light.
  float pinker(const Eigen::Vector2d& p) const;
  bool inside(const Eigen::Vector2d& p) const;

  /// Of pixels: how much darker than before, 0 to 1, where the colour is the same: a shadow's.
  const cv::Mat1f& shade() const { return shade_; }
  cv::Mat1b pink() const;   ///< pixels that have become pinker
  cv::Mat1b thing() const;  ///< that have changed and are no shadow

 private:
  cv::Mat3f before_, now_;
  cv::Mat1f shade_;
};

}  // namespace palpa::bench
