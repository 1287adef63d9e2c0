#include "apps/runtime/camera_activity.h"

#include <new>

#include "anatomy/base/error.h"
#include "apps/runtime/clock.h"

namespace palpa::runtime {
namespace {

constexpr std::int64_t kAskAgain = kSecond;  // after a source has failed

std::optional<Pose> poseAt(const ar::PoseTrack& track, std::int64_t t_ns) {
  const ar::PoseLookup there = track.at(t_ns);
  return there.how == ar::Lookup::none ? std::nullopt : std::optional(there.X);
}

ar::PoseTrack trackOf(const std::optional<CameraActivity::Tracking>& tracked) {
  ar::PoseTrack::Settings settings;
  if (tracked) settings.longest_prediction = tracked->stale;
  return ar::PoseTrack(settings);
}

}  // namespace

CameraActivity::CameraActivity(Bus& bus, Exposer expose, const ar::Board& board,
                               const calibration::CameraModel& camera, const Settings& settings,
                               Observer observer)
    : bus_(bus),
      expose_(std::move(expose)),
      tracker_(board, camera, {{}, !settings.photographs}),
      settings_(settings),
      size_(camera.width, camera.height),
      tracked_(trackOf(settings.tracked)),
      health_(size_),
      observer_(std::move(observer)) {
  for (const auto& other : settings_.others)
    other_trackers_.emplace_back(*other, camera,
                                 ar::BoardTracker::Settings{{}, !settings_.photographs});
}

namespace {

/// `why`: in our words; empty: not known.
CameraView goneIn(CameraView view, const std::string& why) {
  view.fault = ar::PictureFault::gone;
  view.source = why;
  return view;
}

}  // namespace

CameraView CameraActivity::see(const Exposure& exposure, std::int64_t t_ns, std::uint64_t number) {
  if (settings_.parts) return seeParts(exposure, t_ns, number);
  CameraView view;
  view.t_exposure_ns = t_ns;
  view.number = number;
  view.tracking = tracker_.state();
  std::optional<ar::Frame> frame;
  try {
    frame = exposure({});
    // Of the source alone: what goes wrong in the tracking, or memory, is told to the executive
  } catch (const Error& e) {
    return goneIn(std::move(view), e.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const cv::Exception& e) {
    if (e.code == cv::Error::StsNoMem) throw std::bad_alloc();
    return goneIn(std::move(view), "");
  } catch (const std::exception&) {
    return goneIn(std::move(view), "");
  }
  if (!frame) {
    view.fault = ar::PictureFault::ended;
    return view;
  }
  view.source = frame->source;
  view.t_exposure_ns = frame->t_exposure_ns;
  view.picture = std::make_shared<const cv::Mat>(frame->image);
  track(frame->image, &view);
  return view;
}

CameraView CameraActivity::seeParts(const Exposure& exposure, std::int64_t t_ns,
                                    std::uint64_t number) {
  CameraView view;
  view.t_exposure_ns = t_ns;
  view.number = number;
  const auto picture = [&](const cv::Rect& part) {
    const std::optional<ar::Frame> frame = exposure(part);
    if (frame) view.source = frame->source;
    return frame ? frame->image : cv::Mat();
  };
  view.pose = tracker_.see(picture, size_, t_ns);
  place(&view);
  return view;
}

/// Without a picture: what goes on from the points is the same.
CameraView CameraActivity::find(std::int64_t t_ns, std::uint64_t number) {
  CameraView view;
  view.t_exposure_ns = t_ns;
  view.number = number;
  view.source = "tracking model";
  view.pose = tracker_.take(settings_.finder(t_ns, number), t_ns);
  place(&view);
  return view;
}

/// By its own track.
void CameraActivity::place(CameraView* view) const {
  view->X_CW = poseAt(tracker_.track(), view->t_exposure_ns);
  view->tracking = tracker_.state();
}

void CameraActivity::track(const cv::Mat& image, CameraView* view) {
  if (!settings_.photographs) view->fault = health_.judge(image, view->t_exposure_ns);
  if (view->fault == ar::PictureFault::wrong_size) return;
  // A frozen picture shows where the boards were.
  const bool fresh = view->fault != ar::PictureFault::frozen;
  if (settings_.tracked) {
    follow(view);
  } else {
    if (fresh) view->pose = tracker_.see(image, view->t_exposure_ns);
    place(view);
  }
  for (ar::BoardTracker& other : other_trackers_) {
    if (fresh) other.see(image, view->t_exposure_ns);
    view->others.push_back(poseAt(other.track(), view->t_exposure_ns));
  }
}

/// What another tracking system says of the camera's place at the exposure. On the camera's thread
/// alone.
void CameraActivity::follow(CameraView* view) {
  ar::Matrix6 covariance = ar::Matrix6::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(settings_.tracked->sigma_rad *
                                                          settings_.tracked->sigma_rad);
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(settings_.tracked->sigma *
                                                              settings_.tracked->sigma);
  TrackedPose pose;
  while (bus_.tracker_to_camera.pop(&pose)) {
    tracked_.add(pose.X_CW, covariance, pose.t_ns);
    tracked_before_ = true;
  }
  view->by_tracker = true;
  view->X_CW = poseAt(tracked_, view->t_exposure_ns);
  view->tracking = view->X_CW        ? ar::TrackState::tracked
                   : tracked_before_ ? ar::TrackState::lost
                                     : ar::TrackState::searching;
}

/// When the next picture is due.
std::int64_t CameraActivity::publish(const CameraView& view, std::int64_t exposed_ns,
                                     std::int64_t now_ns) {
  bus_.camera_to_scene.publish(view, now_ns);
  bus_.camera_to_task.publish(view, now_ns);
  bus_.camera_to_link.publish({view.t_exposure_ns, view.X_CW}, now_ns);
  if (observer_) observer_(view);
  if (view.fault == ar::PictureFault::ended) return kNever;
  return view.fault == ar::PictureFault::gone ? now_ns + kAskAgain
                                              : exposed_ns + settings_.period_ns;
}

/// The work of one picture, with its inputs as they are now. A model's is too little for a thread.
std::future<CameraView> CameraActivity::begin(std::int64_t now_ns, std::uint64_t number) {
  if (settings_.finder) {
    std::promise<CameraView> found;
    found.set_value(find(now_ns, number));
    return found.get_future();
  }
  return beside_.start([this, exposure = expose_(now_ns, number), now_ns, number] {
    return see(exposure, now_ns, number);
  });
}

std::int64_t CameraActivity::step(std::int64_t now_ns) {
  if (settings_.mode == TimeMode::real) {
    const CameraView view = see(expose_(now_ns, number_), now_ns, number_);
    ++number_;
    return publish(view, now_ns, now_ns);
  }
  if (pending_.valid())
    return publish(pending_.get(), exposed_ns_,
                   now_ns);  // time to show what was exposed `latency_ns` ago
  exposed_ns_ = now_ns;
  pending_ = begin(now_ns, number_++);
  return now_ns + settings_.latency_ns;
}

std::int64_t exposureOf(const ar::Frame& frame, double latency_s, const Clock& clock) {
  constexpr std::int64_t kOldest = 2 * kSecond;
  const std::int64_t now = clock.now(), stamped = clock.ofMonotonic(frame.t_exposure_ns);
  return (stamped <= now && stamped > now - kOldest ? stamped : now) -
         std::llround(1e9 * latency_s);
}

}  // namespace palpa::runtime
