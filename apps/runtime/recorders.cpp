#include "apps/runtime/recorders.h"

#include <cstdio>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/os/real_time.h"
#include "ar/codecs/codecs.h"

namespace palpa::runtime {

std::int64_t RecorderActivity::step(std::int64_t now_ns) {
  drain();
  if (now_ns >= gives_back_ns_) {
    os::giveFreeMemoryBack();
    gives_back_ns_ = now_ns + kKeepsFree_ns;
  }
  return now_ns + period_ns_;
}

/// A trial's end comes last: where the evidence has it, it has the trial's ticks.
void RecorderActivity::drain() {
  std::vector<TrialEnd> ends;
  EvidenceMessage message;
  while (bus_.task_to_recorder.pop(&message)) {
    if (const auto* event = std::get_if<Event>(&message)) sink_.event(*event);
    if (const auto* header = std::get_if<TrialHeader>(&message)) sink_.beginTrial(*header);
    if (const auto* end = std::get_if<TrialEnd>(&message)) ends.push_back(*end);
    bus_.recorder_to_link.push(message);
  }
  LocalGeometry geometry;
  while (bus_.geometry_to_recorder.pop(&geometry)) sink_.snapshot(geometry);
  Keyframe keyframe;
  while (bus_.keyframes_to_recorder.pop(&keyframe)) sink_.keyframe(keyframe.tick, keyframe.state);
  haptics::FlightRecord record;
  while (bus_.haptic_to_recorder.pop(&record)) sink_.tick(record);
  for (const TrialEnd& end : ends) sink_.endTrial(end);
  sink_.commit();
}

namespace {

constexpr int kQuality =
    95;  // corners found again in such pictures are where they were to a twentieth of a pixel

const char* nameOf(ar::PictureFault fault) {
  switch (fault) {
    case ar::PictureFault::black:
      return "black";
    case ar::PictureFault::frozen:
      return "frozen";
    case ar::PictureFault::wrong_size:
      return "wrong_size";
    case ar::PictureFault::gone:
      return "gone";
    case ar::PictureFault::ended:
      return "ended";
    case ar::PictureFault::none:
      break;
  }
  return "";
}

const char* nameOf(ar::TrackState state) {
  switch (state) {
    case ar::TrackState::searching:
      return "searching";
    case ar::TrackState::tracked:
      return "tracked";
    case ar::TrackState::coasting:
      return "coasting";
    case ar::TrackState::lost:
      break;
  }
  return "lost";
}

/// It belongs to the evidence: for this user alone, and never in another's place.
std::filesystem::path claimed(const std::filesystem::path& file) {
  if (const std::error_code problem = os::createNew(file))
    failFile("cannot be written", file, problem, "Or choose another --out");
  return file;
}

}  // namespace

PictureFile::PictureFile(const std::filesystem::path& folder, const std::string& name,
                         const std::string& columns)
    : film_(claimed(folder / (name + ".mjpeg"))),
      pictures_file_(film_, std::ios::binary),
      table_(claimed(film_.string() + ".csv")) {
  if (!pictures_file_ || !table_)
    throw Error("cannot be written", film_.string(), "Choose another --out");
  ar::loadCodecs();
  table_ << "number,t_exposure_ns," << columns << '\n';
}

void PictureFile::add(const cv::Mat& picture, std::int64_t t_ns, int quality,
                      const std::string& fields) {
  if (!trouble_.empty()) return;
  const std::vector<std::uint8_t> jpeg =
      ar::encode(".jpg", picture, {cv::IMWRITE_JPEG_QUALITY, quality});
  pictures_file_.write(reinterpret_cast<const char*>(jpeg.data()),
                       static_cast<std::streamsize>(jpeg.size()));
  table_ << pictures_ << ',' << t_ns << ',' << fields << '\n';
  if (!pictures_file_.flush() || !table_.flush()) {
    trouble_ = "the video could not be written to its end: is the disk full?";
    return;
  }
  ++pictures_;
  bytes_ += jpeg.size();
}

VideoRecorder::VideoRecorder(const std::filesystem::path& folder)
    : file_(folder, "camera",
            "source,fault,tracking,points,rms_px,t_x_m,t_y_m,t_z_m,q_w,q_x,q_y,q_z") {}

void VideoRecorder::add(const CameraView& view) {
  if (!view.picture || view.picture->empty()) return;
  std::string fields = '"' + view.source + "\"," + nameOf(view.fault) + ',' + nameOf(view.tracking);
  if (view.pose) {
    const PackedPose X = pack(view.pose->X_CW);
    char pose[200];
    std::snprintf(pose, sizeof pose, ",%d,%.4f,%.7f,%.7f,%.7f,%.9f,%.9f,%.9f,%.9f",
                  view.pose->points, view.pose->rms_px, X.p[0], X.p[1], X.p[2], X.q[0], X.q[1],
                  X.q[2], X.q[3]);
    fields += pose;
  } else {
    fields += ",0,,,,,,,,";
  }
  file_.add(*view.picture, view.t_exposure_ns, kQuality, fields);
}

}  // namespace palpa::runtime
