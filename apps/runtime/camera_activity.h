#pragma once

#include <functional>
#include <future>
#include <memory>
#include <vector>

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/own_thread.h"
#include "calibration/camera_model.h"

namespace palpa::runtime {

/// CAMERA: exposes, tracks the board, publishes its pose stamped with the time of exposure. A
/// source that fails is asked again once a second; whatever happens to it is told
/// (`CameraView::fault`) and stops nobody. In virtual time the work of one picture runs beside the
/// simulation: its inputs are frozen at the exposure and it is joined when the result becomes
/// visible, so the outcome does not depend on speed.
class CameraActivity final : public Activity {
 public:
  /// How good a tracking system is, and how long after its last pose the camera's place is
  /// predicted; beyond, it is lost.
  struct Tracking {
    double sigma = 0.3e-3, sigma_rad = 2e-3;  ///< m and rad, of each component
    double stale = 0.1;                       ///< s
  };
  /// The points of the table's board that would be found in a picture exposed now.
  using Finder =
      std::function<std::vector<ar::BoardPoint>(std::int64_t now_ns, std::uint64_t number)>;
  struct Settings {
    std::int64_t period_ns = 66'666'667;
    std::int64_t latency_ns = 50'000'000;  ///< exposure to published pose; at most the period
    TimeMode mode = TimeMode::virtual_time;
    bool photographs = false;  ///< each picture stands for itself: no motion between them
    /// Nobody sees the pictures: a part is exposed where the table's board is expected, and the
    /// whole where it is not found there. In virtual time, without other boards; views have no
    /// picture.
    bool parts = false;
    /// X_CW comes by `Bus::tracker_to_camera`; the table's board is not looked for
    std::optional<Tracking> tracked{};
    /// In place of pictures, in virtual time: the exposer is not asked
    Finder finder{};
    /// looked for besides the table's, each with a motion of its own
    std::vector<std::shared_ptr<const ar::Board>> others{};
  };
  /// Freezes the inputs of a picture exposed now, and returns what takes it (run on any thread).
  /// The inner function returns nothing when the source has ended; the frame's time of exposure is
  /// session time. With `Settings::parts` the same picture may be asked for twice, and only this
  /// part of it will be looked at (empty: all).
  using Exposure = std::function<std::optional<ar::Frame>(const cv::Rect& part)>;
  using Exposer = std::function<Exposure(std::int64_t now_ns, std::uint64_t number)>;
  using Observer = std::function<void(const CameraView&)>;  ///< called with every result

  CameraActivity(Bus& bus, Exposer expose, const ar::Board& board,
                 const calibration::CameraModel& camera, const Settings& settings,
                 Observer observer = {});
  const char* name() const override { return "camera"; }
  std::int64_t step(std::int64_t now_ns) override;

 private:
  CameraView see(const Exposure& exposure, std::int64_t t_ns, std::uint64_t number);
  CameraView find(std::int64_t t_ns, std::uint64_t number);
  CameraView seeParts(const Exposure& exposure, std::int64_t t_ns, std::uint64_t number);
  std::future<CameraView> begin(std::int64_t now_ns, std::uint64_t number);
  void track(const cv::Mat& image, CameraView* view);
  void place(CameraView* view) const;
  void follow(CameraView* view);
  std::int64_t publish(const CameraView& view, std::int64_t exposed_ns, std::int64_t now_ns);

  Bus& bus_;
  Exposer expose_;
  ar::BoardTracker tracker_;  ///< used by one picture at a time
  std::vector<ar::BoardTracker> other_trackers_;
  Settings settings_;
  cv::Size size_;          ///< that pictures should have
  ar::PoseTrack tracked_;  ///< by another tracking system, where there is one
  bool tracked_before_ = false;
  ar::PictureHealth health_;
  Observer observer_;
  std::future<CameraView> pending_;
  std::int64_t exposed_ns_ = 0;
  std::uint64_t number_ = 0;
  OwnThread<CameraView> beside_;  ///< of virtual time; last: its work uses all of the above
};

/// When a webcam's picture was exposed, session time. A stamp that cannot be (none, of another
/// clock) gives way to the time of arrival.
std::int64_t exposureOf(const ar::Frame& frame, double latency_s, const Clock& clock);

}  // namespace palpa::runtime
