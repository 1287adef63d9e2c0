#include "apps/session/session_pictures.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "ar/cameras/recorded_pictures.h"

namespace palpa::session {
namespace {

void checkSize(const ar::Frame& picture, const calibration::CameraModel& camera) {
  const int width = picture.image.cols, height = picture.image.rows;
  if (width == camera.width && height == camera.height) return;
  throw UsageError("is " + std::to_string(width) + "x" + std::to_string(height) +
                       ", but the intrinsics are for " + std::to_string(camera.width) + "x" +
                       std::to_string(camera.height),
                   picture.source, "Give the --intrinsics of this camera");
}

ar::WebcamSettings webcamOf(const station::Station& station) {
  const station::CameraSetup& setup = station.camera_setup;
  return {setup.device,
          station.camera.width,
          station.camera.height,
          station.camera_rate_Hz,
          setup.exposure_ms,
          setup.gain,
          setup.focus};
}

}  // namespace

SessionPictures::SessionPictures(const SessionOptions& options, const station::Station& station)
    : station_(station),
      file_(options.camera),
      camera_(station.camera),
      rate_Hz_(station.camera_rate_Hz),
      seen_(!options.no_views || options.record_video) {
  if (!file_.empty())
    source_ = ar::isVideoFile(file_) ? Source::film : Source::photographs;
  else if (station_.camera_setup.driver == station::CameraDriver::webcam)
    source_ = Source::webcam;
  if (source_ == Source::webcam && options.fast)
    throw UsageError("needs real time", "the station's webcam", "Leave out --fast");
  if (options.tracking == Tracking::model) readModel();
  pictures_ = opened();
  if (!file_.empty()) {
    if (const auto first = opened()->grab()) checkSize(*first, camera_);
    if (const auto* film = dynamic_cast<const ar::VideoFile*>(pictures_.get()))
      rate_Hz_ = film->rate_Hz();
    if (const auto* sequence = dynamic_cast<const ar::ImageSequence*>(pictures_.get()))
      photographs_ = sequence->files().size();
  }
  board_ = options.board.empty()
               ? ar::makeBoard(station_.board, station_.decimate)
               : ar::makeBoard(options.board, file_.empty() ? station_.decimate : 1.0);
}

SessionPictures::~SessionPictures() = default;

/// The shipped figures, or those that the station names. A station on which more than the table's
/// board is watched, or on which pictures go wrong, needs pictures.
void SessionPictures::readModel() {
  const auto refuse = [&](const char* field, const std::string& what) {
    throw UsageError(what, station_.file.name() + ", " + field, "Leave out --tracking model");
  };
  if (!station_.simulated || source_ != Source::bench)
    refuse("camera", "is a real one, and the tracking model stands for the simulated one's");
  if (station_.tracker) refuse("tracker", "tracks the camera, so that no model can");
  if (!station_.boards.empty()) refuse("boards", "are not known to the tracking model");
  if (station_.file.has("twin/camera_faults"))
    refuse("twin/camera_faults", "are faults of pictures, and the tracking model has none");
  model_ = twin::trackingFiguresOf(station_);
}

std::unique_ptr<ar::Camera> SessionPictures::opened() const {
  switch (source_) {
    case Source::webcam:
      return std::make_unique<ar::Webcam>(webcamOf(station_));
    case Source::film:
      return std::make_unique<ar::VideoFile>(file_);
    case Source::photographs:
      return std::make_unique<ar::ImageSequence>(file_, rate_Hz_);
    case Source::bench:
      break;
  }
  return nullptr;
}

runtime::CameraActivity::Settings SessionPictures::settings(runtime::TimeMode mode,
                                                            const twin::VirtualBench* bench) const {
  constexpr double kDeviceWaits_Hz = 1000;  // a webcam's own pace: asking it waits
  runtime::CameraActivity::Settings settings;
  settings.period_ns =
      static_cast<std::int64_t>(1e9 / (source_ == Source::webcam ? kDeviceWaits_Hz : rate_Hz_));
  settings.latency_ns =
      static_cast<std::int64_t>(1e9 * std::min(station_.camera_latency_s, 1 / rate_Hz_));
  settings.mode = mode;
  settings.photographs = photographs();
  if (model_) settings.finder = bench->finder(*model_);
  settings.parts = mode == runtime::TimeMode::virtual_time && !seen_ && fromBench() &&
                   station_.boards.empty() && !station_.tracker &&
                   !station_.file.has("twin/camera_faults");
  if (file_.empty() && station_.tracker)
    settings.tracked = {station_.tracker->sigma, station_.tracker->sigma_rad,
                        station_.tracker->stale_s};
  if (file_.empty())
    for (const station::OtherBoard& other : station_.boards)
      settings.others.push_back(ar::makeBoard(other.grid, station_.decimate));
  return settings;
}

std::optional<ar::Frame> SessionPictures::take(std::int64_t now_ns, std::uint64_t number,
                                               const runtime::Clock& clock) {
  try {
    if (!pictures_) pictures_ = opened();
    std::optional<ar::Frame> frame = pictures_->grab();
    if (!frame && photographs()) {  // over again
      pictures_ = opened();
      frame = pictures_->grab();
    }
    if (!frame) return frame;
    frame->number = number;
    frame->t_exposure_ns = source_ == Source::webcam
                               ? runtime::exposureOf(*frame, station_.camera_latency_s, clock)
                               : now_ns;
    return frame;
  } catch (...) {
    if (source_ == Source::webcam) pictures_.reset();  // to be opened anew
    throw;
  }
}

runtime::CameraActivity::Exposer SessionPictures::exposer(twin::VirtualBench* bench,
                                                          const runtime::Clock& clock) {
  if (model_) return {};
  if (fromBench()) return bench->exposer();
  return [this, &clock](std::int64_t now_ns, std::uint64_t number) {
    return [this, &clock, now_ns, number](const cv::Rect&) { return take(now_ns, number, clock); };
  };
}

runtime::CameraActivity::Observer SessionPictures::observer(twin::VirtualBench* bench) {
  if (fromBench()) return [bench](const runtime::CameraView& view) { bench->observe(view); };
  return [this](const runtime::CameraView& view) { note(view); };
}

std::vector<std::string> SessionPictures::remarks() const {
  const auto* webcam = dynamic_cast<const ar::Webcam*>(pictures_.get());
  return webcam ? webcam->remarks() : std::vector<std::string>();
}

void SessionPictures::note(const runtime::CameraView& view) {
  if (registration_.size() >= photographs_ || view.fault == ar::PictureFault::ended) return;
  RegistrationRow row{view.source, 0, 0, Pose::Identity()};
  if (view.pose) row = {view.source, view.pose->points, view.pose->rms_px, view.pose->X_CW};
  registration_.push_back(row);
}

std::unique_ptr<runtime::RoomFilm> roomFilm(const SessionOptions& options,
                                            const station::Station& station,
                                            const std::filesystem::path& folder,
                                            const runtime::Clock& clock) {
  const std::string& from = options.film_room;
  if (from.empty()) return nullptr;
  const bool film = ar::isVideoFile(from);
  if (station.camera_setup.driver == station::CameraDriver::webcam &&
      station.camera_setup.device == from)
    throw UsageError("is the camera that the station watches", "--film-room " + from,
                     "Name another camera, or leave it out");
  const auto open = [from, film]() -> std::unique_ptr<ar::Camera> {
    if (film) return std::make_unique<ar::VideoFile>(from);
    ar::WebcamSettings settings;
    settings.device = from;
    settings.adjusts = true;
    return std::make_unique<ar::Webcam>(settings);
  };
  return std::make_unique<runtime::RoomFilm>(open, !film, folder, clock);
}

}  // namespace palpa::session
