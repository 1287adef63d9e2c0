#pragma once

#include <cstdint>
#include <memory>

#include <opencv2/core.hpp>

#include "anatomy/base/random.h"
#include "apps/bench/bench.h"
#include "apps/twin/virtual_camera.h"
#include "ar/boards/board.h"

namespace palpa::bench {

/// The virtual bench's board before a virtual camera whose truth is known.
class TrackingScene {
 public:
  explicit TrackingScene(const TrackingBenchOptions& options);

  const calibration::CameraModel& camera() const { return camera_; }
  const ar::TagGridSpec& spec() const { return spec_; }
  const ar::Board& board() const { return *board_; }

  /// From `distance`, `tilt` away from straight above, round the board by `azimuth`, rolled; its
  /// middle in the middle of the picture. rad, m.
  static Pose view(double distance, double tilt, double azimuth, double roll);
  Pose anyView(RandomStream& random, double distance, double most_tilt) const;

  cv::Mat still(const Pose& X_CW, std::uint64_t number) const;
  /// Of a motion: the mean of what was there while the shutter was open about t.
  template <class Motion>
  cv::Mat moving(const Motion& X_CW, double t, std::uint64_t number) const {
    constexpr int kParts = 4;
    constexpr double kExposure = 0.005;  // s
    cv::Mat sum(camera_.height, camera_.width, CV_32F, cv::Scalar(0));
    for (int i = 0; i < kParts; ++i)
      add(X_CW(t + kExposure * ((i + 0.5) / kParts - 0.5)), 1.0 / kParts, &sum);
    return exposed(sum, number);
  }

 private:
  void add(const Pose& X_CW, double weight, cv::Mat* sum) const;
  cv::Mat exposed(const cv::Mat& sum, std::uint64_t number) const;

  calibration::CameraModel camera_;
  ar::TagGridSpec spec_;
  std::unique_ptr<ar::Board> board_;
  std::unique_ptr<twin::VirtualCamera> noisy_, clean_;
  std::uint64_t seed_;
};

/// A hand's way there and back, minimum jerk, across the view and along it, turning on the way;
/// `peak` m/s.
class HandMotion {
 public:
  HandMotion(const Pose& X_CW, double peak) : X_CW_(X_CW), peak_(peak) {}
  Pose operator()(double t) const;
  /// Speed of a point of the board there, m/s.
  Vec3 velocity(double t, const Vec3& p_W) const;

 private:
  Pose X_CW_;
  double peak_;
};

/// Picture `i` of a series without any board of ours: noise of fine and coarse grain, lines of
/// text, sheets of tags of other families, and random cells in black squares, which look most like
/// tags; in turn.
cv::Mat falsePicture(int i, cv::Size size, std::uint64_t seed);

}  // namespace palpa::bench
