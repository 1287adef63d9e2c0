#include "apps/runtime/video_recorder.h"

#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "anatomy/geometry/error.h"

namespace palpa::runtime {
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

}  // namespace

VideoRecorder::VideoRecorder(const std::filesystem::path& folder)
    : film_(folder / "camera.mjpeg"),
      pictures_file_(film_, std::ios::binary),
      table_(film_.string() + ".csv") {
  if (!pictures_file_ || !table_)
    throw Error("cannot be written", film_.string(), "Choose another --out");
  table_ << "number,t_exposure_ns,source,fault,tracking,points,rms_px,t_x_m,t_y_m,t_z_m,q_w,q_x,q_"
            "y,q_z\n";
}

void VideoRecorder::add(const CameraView& view) {
  if (!trouble_.empty() || !view.picture || view.picture->empty()) return;
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", *view.picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  pictures_file_.write(reinterpret_cast<const char*>(jpeg.data()),
                       static_cast<std::streamsize>(jpeg.size()));
  table_ << pictures_ << ',' << view.t_exposure_ns << ",\"" << view.source << "\","
         << nameOf(view.fault) << ',' << nameOf(view.tracking);
  if (view.pose) {
    const PackedPose X = pack(view.pose->X_CW);
    char pose[200];
    std::snprintf(pose, sizeof pose, ",%d,%.4f,%.7f,%.7f,%.7f,%.9f,%.9f,%.9f,%.9f",
                  view.pose->points, view.pose->rms_px, X.p[0], X.p[1], X.p[2], X.q[0], X.q[1],
                  X.q[2], X.q[3]);
    table_ << pose;
  } else {
    table_ << ",0,,,,,,,,";
  }
  table_ << '\n';
  if (!pictures_file_.flush() || !table_.flush())
    trouble_ = "the video could not be written to its end: is the disk full?";
  else
    ++pictures_;
}

}  // namespace palpa::runtime
