#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>

#include "ar/boards/board.h"
#include "ar/tracking/board_pose.h"
#include "ar/tracking/pose_track.h"

namespace palpa::ar {

/// searching: not seen so far. tracked: seen in the last picture. coasting: not seen in it, but so
/// recently that its pose is predicted. lost: neither.
enum class TrackState { searching, tracked, coasting, lost };

/// Finds one board in picture after picture: first around where its motion takes it, in the whole
/// picture where it is not there.
///
/// What is found must be believable before it counts: it fits the board's plane (`kWorstFit_px`); a
/// board that is not tracked must show as many points as chance does not (`Board::leastPoints`),
/// and its two planar solutions must differ in how well they fit; one that is tracked must be where
/// its motion can have taken it, and of two solutions that fit alike that one is taken. Not for
/// several threads at once.
class BoardTracker {
 public:
  struct Settings {
    PoseTrack::Settings track;
    bool motion = true;  ///< false: each picture stands for itself, as photographs do
  };
  BoardTracker(const Board& board, const calibration::CameraModel& camera)
      : BoardTracker(board, camera, Settings{}) {}
  BoardTracker(const Board& board, const calibration::CameraModel& camera,
               const Settings& settings);

  /// Pose of the board in the picture exposed at `t_ns`, as it was measured there; nothing where it
  /// is not seen.
  std::optional<BoardPose> see(const cv::Mat& image, std::int64_t t_ns);
  /// The whole of a picture, of which at least this part is drawn; an empty part: all of it.
  using Picture = std::function<cv::Mat(const cv::Rect& part)>;
  /// The same, where each part of a picture costs: only what is looked at is asked for.
  std::optional<BoardPose> see(const Picture& picture, const cv::Size& size, std::int64_t t_ns);
  /// The same with the points that were found in that picture.
  std::optional<BoardPose> take(const std::vector<BoardPoint>& points, std::int64_t t_ns);

  TrackState state() const { return state_; }
  /// The filtered pose at any time; its covariance is by the pixel noise that the pictures
  /// themselves show.
  const PoseTrack& track() const { return track_; }
  /// Where the board was looked for in the last picture, pixels; empty: everywhere.
  const cv::Rect& region() const { return region_; }

 private:
  cv::Rect expected(const cv::Size& size, std::int64_t t_ns) const;
  std::optional<BoardPose> believable(const std::vector<BoardPoint>& points,
                                      std::int64_t t_ns) const;
  Matrix6 scaled(const BoardPose& pose) const;
  std::optional<BoardPose> conclude(const std::vector<BoardPoint>& points,
                                    std::optional<BoardPose> pose, std::int64_t t_ns);
  void learn(const std::vector<BoardPoint>& points, const BoardPose& pose);

  const Board& board_;
  calibration::CameraModel camera_;
  Settings settings_;
  PoseTrack track_;
  TrackState state_ = TrackState::searching;
  cv::Rect region_;
  Eigen::AlignedBox2d extent_;  ///< of the points that were ever seen, on the board, m
  double sigma_px_;
};

}  // namespace palpa::ar
