#include "apps/runtime/recorders.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "apps/runtime/clock.h"
#include "ar/boards/board.h"
#include "ar/cameras/recorded_pictures.h"
#include "ar/cameras/webcam.h"
#include "tests/support/scratch_folder.h"

namespace palpa::runtime {
namespace {

CameraView viewOf(int i) {
  // A little askew, as boards lie: edges along the pixels are a degenerate case for finding
  // corners.
  static const cv::Mat board = [] {
    const cv::Mat straight = ar::drawTagGrid({3, 2, 0.030, 0.0075, 0}, 3000),
                  turn = (cv::Mat_<double>(2, 3) << 1, 0.05, 0, -0.04, 1, 5);
    cv::Mat askew;
    cv::warpAffine(straight, askew, turn, straight.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return askew;
  }();
  CameraView view;
  view.number = static_cast<std::uint64_t>(i);
  view.source = "virtual camera";
  view.t_exposure_ns = 1'000'000'000 + 40'000'000LL * i;
  cv::Mat picture;
  cv::GaussianBlur(board, picture, {0, 0}, 1 + 0.1 * i);
  cv::Mat noise(picture.size(), CV_32F), exposed;
  cv::RNG random(static_cast<std::uint64_t>(i) + 1);
  random.fill(noise, cv::RNG::NORMAL, 50, 3);
  exposed =
      noise + 0.6 * cv::Mat_<float>(
                        picture);  // paper is not white, ink not black, and no sensor without noise
  exposed.convertTo(picture, CV_8U);
  view.picture = std::make_shared<const cv::Mat>(picture);
  return view;
}

TEST(VideoRecorder, WhatIsKeptComesBackWithItsTimesAndItsCorners) {
  const test::ScratchFolder folder("video");
  constexpr int kPictures = 6;
  {
    VideoRecorder recorder(folder.path());
    for (int i = 0; i < kPictures; ++i) {
      CameraView view = viewOf(i);
      if (i == 4) view.pose.emplace().points = 24;
      if (i == 5) view.fault = ar::PictureFault::frozen;
      recorder.add(view);
    }
    CameraView gone;
    gone.fault = ar::PictureFault::gone;
    recorder.add(gone);  // no picture: nothing to keep
    EXPECT_EQ(recorder.pictures(), static_cast<std::uint64_t>(kPictures));
    EXPECT_EQ(recorder.trouble(), "");
  }
  const auto board = ar::makeBoard("tags:3x2:0.030:0.0075", 1.0);
  ar::VideoFile film(folder / "camera.mjpeg");
  int seen = 0;
  while (const auto frame = film.grab()) {
    const CameraView view = viewOf(seen++);
    EXPECT_EQ(frame->t_exposure_ns, view.t_exposure_ns);
    const auto was = board->detect(*view.picture), is = board->detect(frame->image);
    ASSERT_EQ(was.size(), 24u);
    ASSERT_EQ(is.size(), was.size());
    double squares = 0;
    for (std::size_t k = 0; k < was.size(); ++k)
      squares += (is[k].pixel - was[k].pixel).squaredNorm() / static_cast<double>(was.size());
    EXPECT_LT(std::sqrt(squares), 0.1);  // measured 0.05; a tracker's own noise is 0.1 to 0.2
  }
  EXPECT_EQ(seen, kPictures);
  EXPECT_NEAR(film.rate_Hz(), 25, 1e-9);  // by the table: pictures 40 ms apart
  std::ifstream table(folder / "camera.mjpeg.csv");
  std::string line, text;
  while (std::getline(table, line)) text += line + "\n";
  EXPECT_NE(text.find("4,1160000000,\"virtual camera\",,searching,24,"), std::string::npos) << text;
  EXPECT_NE(text.find("5,1200000000,\"virtual camera\",frozen,searching,0,"), std::string::npos)
      << text;
}

/// No file may grow beyond some bytes, as on a disk that is full.
class FullDisk {
 public:
  FullDisk() {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit little{100, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &little);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

TEST(VideoRecorder, AFullDiskEndsTheRecordingOnly) {
  const test::ScratchFolder folder("video_full");
  VideoRecorder recorder(folder.path());
  {
    const FullDisk full;
    for (int i = 0; i < 3; ++i) EXPECT_NO_THROW(recorder.add(viewOf(i)));
  }
  EXPECT_NE(recorder.trouble(), "");
  EXPECT_EQ(recorder.pictures(), 0u);
}

TEST(VideoFile, WhatIsNoFilmIsTold) {
  const test::ScratchFolder folder("video_none");
  EXPECT_THROW(ar::VideoFile(folder / "nowhere.mp4"), Error);
  std::ofstream(folder / "words.avi") << "these are words";
  EXPECT_THROW(ar::VideoFile(folder / "words.avi"), Error);
}

TEST(Webcam, ACameraThatIsNotThereIsTold) {
  ar::WebcamSettings settings;
  settings.device = "/dev/video99";
  EXPECT_THROW(ar::Webcam{settings}, Error);
  settings.device = "/dev/null";  // no camera
  EXPECT_THROW(ar::Webcam{settings}, Error);
}

TEST(Clock, StampsOfDriversAreSessionTime) {
  const SteadyClock first;
  first.sleepUntil(first.now() + 5 * kMillisecond);
  const SteadyClock second;
  const std::int64_t apart_at_least =
      first.now() - second.now();  // read one after the other: a little less than they are apart
  EXPECT_GE(first.ofMonotonic(0) - second.ofMonotonic(0), apart_at_least);
  EXPECT_GE(apart_at_least, 4 * kMillisecond);
}

}  // namespace
}  // namespace palpa::runtime
