#include "apps/runtime/camera_activity.h"

namespace palpa::runtime {

CameraActivity::CameraActivity(Bus& bus, Exposer expose, const ar::Board& board,
                               const calibration::CameraModel& camera, const Settings& settings,
                               Observer observer)
    : bus_(bus),
      expose_(std::move(expose)),
      tracker_(board, camera),
      settings_(settings),
      observer_(std::move(observer)) {}

CameraActivity::~CameraActivity() {
  if (pending_.valid()) pending_.wait();
}

CameraView CameraActivity::see(const Exposure& exposure, std::int64_t t_ns,
                               std::uint64_t number) {
  CameraView view;
  view.t_exposure_ns = t_ns;
  view.number = number;
  std::optional<ar::Frame> frame = exposure();
  if (!frame) {
    view.ended = true;
    return view;
  }
  view.source = frame->source;
  view.picture = std::make_shared<const cv::Mat>(frame->image);
  view.pose = tracker_.see(frame->image);
  return view;
}

void CameraActivity::publish(const CameraView& view, std::int64_t now_ns) {
  ended_ = view.ended;
  bus_.camera_to_scene.publish(view, now_ns);
  bus_.camera_to_task.publish(view, now_ns);
  if (observer_) observer_(view);
}

std::int64_t CameraActivity::step(std::int64_t now_ns) {
  if (settings_.mode == TimeMode::real) {
    publish(see(expose_(now_ns, number_), now_ns, number_), now_ns);
    ++number_;
    return ended_ ? kNever : now_ns + settings_.period_ns;
  }
  if (pending_.valid()) {  // time to show what was exposed `latency_ns` ago
    publish(pending_.get(), now_ns);
    return ended_ ? kNever : exposed_ns_ + settings_.period_ns;
  }
  exposed_ns_ = now_ns;
  pending_ = std::async(std::launch::async,
                        [this, exposure = expose_(now_ns, number_), now_ns, number = number_] {
                          return see(exposure, now_ns, number);
                        });
  ++number_;
  return now_ns + settings_.latency_ns;
}

}  // namespace palpa::runtime
