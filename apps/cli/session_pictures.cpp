#include "apps/cli/session_pictures.h"

#include "anatomy/geometry/error.h"
#include "ar/image_sequence.h"

namespace palpa::cli {

class SessionPictures::Loop {
 public:
  Loop(const std::string& glob, double fps) : glob_(glob), fps_(fps), source_(glob, fps) {}
  std::size_t count() const { return source_.files().size(); }
  std::optional<ar::Frame> next() {
    std::optional<ar::Frame> frame = source_.grab();
    if (!frame) {
      source_ = ar::ImageSequence(glob_, fps_);
      frame = source_.grab();
    }
    return frame;
  }

 private:
  std::string glob_;
  double fps_;
  ar::ImageSequence source_;
};

namespace {

void checkSize(const ar::Frame& picture, const calibration::CameraModel& camera) {
  const int width = picture.image.cols, height = picture.image.rows;
  if (width == camera.width && height == camera.height) return;
  throw UsageError("is " + std::to_string(width) + "x" + std::to_string(height) + ", but the intrinsics are for " +
                       std::to_string(camera.width) + "x" + std::to_string(camera.height),
                   picture.source, "Give the --intrinsics of this camera");
}

}  // namespace

SessionPictures::SessionPictures(const SessionOptions& options, const NeedleWorld& world)
    : station_(world.station), camera_(world.station.camera) {
  if (!options.camera.empty()) {
    if (const auto first = Loop(options.camera, station_.camera_rate_Hz).next()) checkSize(*first, camera_);
    recorded_ = std::make_unique<Loop>(options.camera, station_.camera_rate_Hz);
  }
  board_ = options.board.empty() ? ar::makeBoard(station_.board, station_.decimate)
                                 : ar::makeBoard(options.board, recorded_ ? 1.0 : station_.decimate);
}

SessionPictures::~SessionPictures() = default;

runtime::CameraActivity::Settings SessionPictures::settings(runtime::TimeMode mode) const {
  return {static_cast<std::int64_t>(1e9 / station_.camera_rate_Hz), static_cast<std::int64_t>(1e9 * station_.camera_latency_s), mode, recorded()};
}

runtime::CameraActivity::Exposer SessionPictures::exposer(twin::VirtualBench* bench) {
  if (!recorded_) return bench->exposer();
  return [this](std::int64_t now_ns, std::uint64_t number) {
    return [this, now_ns, number]() {
      auto frame = recorded_->next();
      if (frame) frame->t_exposure_ns = now_ns, frame->number = number;
      return frame;
    };
  };
}

runtime::CameraActivity::Observer SessionPictures::observer(twin::VirtualBench* bench) {
  if (!recorded_) return [bench](const runtime::CameraView& view) { bench->observe(view); };
  return [this](const runtime::CameraView& view) { note(view); };
}

void SessionPictures::note(const runtime::CameraView& view) {
  if (registration_.size() >= recorded_->count() || view.fault == ar::PictureFault::ended) return;
  RegistrationRow row{view.source, 0, 0, Pose::Identity()};
  if (view.pose) row = {view.source, view.pose->points, view.pose->rms_px, view.pose->X_CW};
  registration_.push_back(row);
}

}  // namespace palpa::cli
