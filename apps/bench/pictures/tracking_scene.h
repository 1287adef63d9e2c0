#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "anatomy/base/random.h"
#include "apps/bench/bench.h"
#include "apps/twin/tracking_model.h"
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

enum class TrackedBy { pictures, model };

/// One camera on its boom, for so many pictures: what the tracker makes of them, against what it
/// would make of corners without any error (the calibration's share in the error is left out, as it
/// is the same in both).
struct TrackedSession {
  struct Error {
    Vec3 shift_mm, turn_mrad;  ///< of a point at the patient's entry; of the board
  };
  std::vector<Error> measured, filtered;  ///< where there is a pose
  int pictures = 0;
  double tags_missed = 0;  ///< sum over the pictures of the share of tags that are in no pose
};
TrackedSession trackedSession(const station::Station& station, std::uint64_t seed, int pictures,
                              TrackedBy by, const twin::TrackingFigures& figures);

inline constexpr std::array<int, 4> kTrackingLags{1, 3, 8, 15};  ///< pictures

struct PathFigures {
  double shift_mm = 0, turn_mrad = 0, filtered_shift_mm = 0, filtered_turn_mrad = 0;  ///< rms
  /// of the measured shift about its session's mean
  std::array<double, kTrackingLags.size()> autocorrelation{};
  double tags_missed = 0, poses_missed = 0;  ///< shares
};
PathFigures figuresOf(const std::vector<TrackedSession>& sessions);

}  // namespace palpa::bench
