#include "apps/runtime/camera_activity.h"

#include <gtest/gtest.h>

#include <atomic>
#include <tuple>

#include "activities.h"

namespace palpa::runtime {
namespace {

constexpr std::int64_t kPeriod = 40 * kMillisecond, kLatency = 25 * kMillisecond;
constexpr std::uint64_t kPictures = 6;

/// Virtual time as the worker threads may wait for it.
std::atomic<std::int64_t> virtual_now{0};

void waitUntil(std::int64_t t_ns) {
  for (std::int64_t now = virtual_now.load(); now < t_ns; now = virtual_now.load())
    virtual_now.wait(now);
}

ar::Frame blank(std::int64_t t_ns, std::uint64_t number) {
  ar::Frame frame;
  frame.number = number;
  frame.t_exposure_ns = t_ns;
  frame.image = cv::Mat(64, 64, CV_8UC1, cv::Scalar(static_cast<double>(number)));
  frame.source = "picture " + std::to_string(number);
  return frame;
}

struct Seen {
  std::int64_t first_ns, exposure_ns;
  std::uint64_t number;
  std::string source;
  int grey;
  bool operator==(const Seen& o) const {
    return std::tie(first_ns, exposure_ns, number, source, grey) ==
           std::tie(o.first_ns, o.exposure_ns, o.number, o.source, o.grey);
  }
};

/// What a reader that looks every millisecond sees, and when. `slow`: each picture is ready only in
/// the last millisecond before it is due.
std::vector<Seen> run(bool slow) {
  virtual_now = 0;
  const auto executive = makeVirtualExecutive();
  Bus bus(TimeMode::virtual_time);
  const auto board = ar::makeBoard("tags:2x2:0.030:0.0075");
  const calibration::CameraModel camera{64, 64, 60, 60, 31.5, 31.5, {}, 0};
  const auto expose = [slow](std::int64_t now, std::uint64_t number) -> CameraActivity::Exposure {
    return [=]() -> std::optional<ar::Frame> {
      if (slow) waitUntil(now + kLatency - kMillisecond);
      if (number == kPictures) return std::nullopt;
      return blank(now, number);
    };
  };
  CameraActivity activity(bus, expose, *board, camera, {kPeriod, kLatency, TimeMode::virtual_time});
  std::vector<Seen> log;
  bool ended = false;
  Doing reader("reader", [&](std::int64_t now) {
    virtual_now = now;
    virtual_now.notify_all();
    const CameraView* view = bus.camera_to_scene.read(now);
    if (view && view->ended) ended = true;
    if (view && !view->ended && (log.empty() || log.back().number != view->number))
      log.push_back({now, view->t_exposure_ns, view->number, view->source,
                     view->picture->at<std::uint8_t>(0, 0)});
    return ended ? kNever : now + kMillisecond;
  });
  executive->add(activity, {3, false, false});
  executive->add(reader, {4, false, false});
  executive->run();
  EXPECT_TRUE(ended) << "the end of the source is told";
  return log;
}

TEST(CameraActivity, ResultIsVisibleExactlyAtExposureAndLatency) {
  const std::vector<Seen> log = run(false);
  ASSERT_EQ(log.size(), kPictures);
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_EQ(log[i].number, i);
    EXPECT_EQ(log[i].exposure_ns, static_cast<std::int64_t>(i) * kPeriod);
    EXPECT_EQ(log[i].first_ns, log[i].exposure_ns + kLatency);
    EXPECT_EQ(log[i].grey, static_cast<int>(i));
  }
}

TEST(CameraActivity, OutcomeDoesNotDependOnTheSpeedOfTheWork) { EXPECT_EQ(run(true), run(false)); }

TEST(CameraActivity, PictureWithoutABoardHasNoPoseAndOneWithItHas) {
  Bus bus(TimeMode::real);
  const ar::TagGridSpec spec{3, 2, 0.030, 0.0075, 0};
  const auto board = ar::makeBoard(spec, 1.0);
  const cv::Mat drawn = ar::drawTagGrid(spec, 3000);
  const calibration::CameraModel camera{drawn.cols,       drawn.rows,       500, 500,
                                        drawn.cols / 2.0, drawn.rows / 2.0, {},  0};
  bool with_board = false;
  const auto expose = [&](std::int64_t now, std::uint64_t number) -> CameraActivity::Exposure {
    return [&, now, number]() -> std::optional<ar::Frame> {
      ar::Frame frame = blank(now, number);
      if (with_board) frame.image = drawn;
      return frame;
    };
  };
  int observed = 0;
  CameraActivity activity(bus, expose, *board, camera, {kPeriod, kLatency, TimeMode::real},
                          [&](const CameraView&) { ++observed; });
  EXPECT_EQ(activity.step(100), 100 + kPeriod);
  ASSERT_NE(bus.camera_to_task.read(0), nullptr);
  EXPECT_FALSE(bus.camera_to_task.read(0)->pose);
  with_board = true;
  activity.step(200);
  const CameraView* view = bus.camera_to_task.read(0);
  ASSERT_TRUE(view->pose);
  EXPECT_EQ(view->pose->points, 24);  // 6 tags of 4 corners
  EXPECT_EQ(view->t_exposure_ns, 200);
  // 3000 px/m and 500 px focal length: the sheet is seen from 500 / 3000 m.
  EXPECT_NEAR(view->pose->X_CW.translation().z(), 500.0 / 3000, 0.001);
  EXPECT_EQ(observed, 2);
}

TEST(CameraActivity, FaultOfTheSourceReachesTheExecutive) {
  Bus bus(TimeMode::virtual_time);
  const auto board = ar::makeBoard("tags:2x2:0.030:0.0075");
  const auto expose = [](std::int64_t, std::uint64_t) -> CameraActivity::Exposure {
    return []() -> std::optional<ar::Frame> { throw std::runtime_error("lens cap"); };
  };
  CameraActivity activity(bus, expose, *board, {64, 64, 60, 60, 31.5, 31.5, {}, 0},
                          {kPeriod, kLatency, TimeMode::virtual_time});
  const auto executive = makeVirtualExecutive();
  executive->add(activity, {});
  EXPECT_THROW(executive->run(), std::runtime_error);
}

}  // namespace
}  // namespace palpa::runtime
