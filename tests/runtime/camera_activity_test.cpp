#include "apps/runtime/camera_activity.h"
#include "apps/runtime/camera_trouble.h"

#include <gtest/gtest.h>

#include <atomic>
#include <tuple>

#include "activities.h"
#include "anatomy/base/error.h"

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
    return [=](const cv::Rect&) -> std::optional<ar::Frame> {
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
    if (view && view->fault == ar::PictureFault::ended) ended = true;
    if (view && view->picture && (log.empty() || log.back().number != view->number))
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
    return [&, now, number](const cv::Rect&) -> std::optional<ar::Frame> {
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

/// A board that is pushed slowly, and far away after picture 6.
cv::Mat pushed(const cv::Mat& sheet, std::uint64_t number) {
  cv::Mat picture(480, 640, CV_8UC1, cv::Scalar(105));
  const int left = static_cast<int>((number > 6 ? 350 : 60) + 2 * number);
  sheet.copyTo(picture(cv::Rect({left, 120}, sheet.size())));
  return picture;
}

struct Followed {
  std::vector<std::optional<Pose>> poses;
  std::vector<std::vector<cv::Rect>> asked;  ///< of each picture
};

/// Nothing but the part that is asked for is in a picture.
Followed follow(bool parts) {
  constexpr std::uint64_t kCount = 10;
  Bus bus(TimeMode::virtual_time);
  const ar::TagGridSpec spec{3, 2, 0.030, 0.0075, 0};
  const auto board = ar::makeBoard(spec, 1.0);
  const cv::Mat sheet = ar::drawTagGrid(spec, 1500);
  Followed followed;
  const auto expose = [&](std::int64_t now, std::uint64_t number) -> CameraActivity::Exposure {
    followed.asked.emplace_back();
    return [&, now, number](const cv::Rect& part) -> std::optional<ar::Frame> {
      followed.asked.back().push_back(part);
      ar::Frame frame = blank(now, number);
      frame.image = pushed(sheet, number);
      if (part.empty()) return frame;
      cv::Mat rest(frame.image.size(), CV_8UC1, cv::Scalar(255));
      rest(part).setTo(0);
      frame.image.setTo(0, rest);
      return frame;
    };
  };
  CameraActivity::Settings settings{kPeriod, kLatency, TimeMode::virtual_time};
  settings.parts = parts;
  CameraActivity activity(bus, expose, *board, {640, 480, 500, 500, 319.5, 239.5, {}, 0}, settings);
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const std::int64_t shown = activity.step(static_cast<std::int64_t>(i) * kPeriod);
    activity.step(shown);
    const CameraView* view = bus.camera_to_task.read(shown);
    EXPECT_EQ(view->number, i);
    EXPECT_EQ(view->picture == nullptr, parts);
    followed.poses.push_back(view->pose ? std::optional(view->pose->X_CW) : std::nullopt);
  }
  return followed;
}

TEST(CameraActivity, InPartsItFindsWhatItFindsInTheWhole) {
  const Followed whole = follow(false), parts = follow(true);
  for (std::size_t i = 0; i < whole.poses.size(); ++i) {
    ASSERT_EQ(parts.poses[i].has_value(), whole.poses[i].has_value()) << i;
    if (whole.poses[i]) {
      EXPECT_EQ(parts.poses[i]->matrix(), whole.poses[i]->matrix()) << i;
    }
    const std::vector<cv::Rect>& asked = parts.asked[i];
    const bool elsewhere = i == 7 || i == 8;  // a jump is believed when it is seen twice
    ASSERT_EQ(asked.size(), elsewhere ? 2u : 1u) << i;
    EXPECT_EQ(asked.back().empty(), elsewhere || i == 0) << i;
  }
  EXPECT_TRUE(parts.poses[6] && !parts.poses[7] && parts.poses[8]);
}

/// What a source does to the pictures; what is told of it; and that it goes on.
struct Told {
  std::vector<ar::PictureFault> faults;
  std::vector<std::string> words;
};

Told tellOf(const std::function<std::optional<ar::Frame>(std::int64_t, std::uint64_t)>& source,
            int steps) {
  Bus bus(TimeMode::real);
  const auto board = ar::makeBoard("tags:2x2:0.030:0.0075");
  CameraActivity activity(
      bus,
      [&](std::int64_t now, std::uint64_t number) -> CameraActivity::Exposure {
        return [&source, now, number](const cv::Rect&) { return source(now, number); };
      },
      *board, {64, 64, 60, 60, 31.5, 31.5, {}, 0}, {kPeriod, kLatency, TimeMode::real});
  Told told;
  std::int64_t now = 0;
  for (int i = 0; i < steps && now != kNever; ++i) {
    const std::int64_t t = now;
    now = activity.step(t);
    const CameraView* view = bus.camera_to_task.read(t);
    told.faults.push_back(view->fault);
    told.words.push_back(cameraTrouble(view, t));
  }
  return told;
}

ar::Frame noisy(std::int64_t t, std::uint64_t number) {
  ar::Frame frame = blank(t, number);
  cv::RNG random(number + 1);
  random.fill(frame.image, cv::RNG::UNIFORM, 60, 90);
  return frame;
}

TEST(CameraActivity, ASourceThatFailsIsToldAndAskedAgain) {
  const Told told = tellOf(
      [](std::int64_t t, std::uint64_t n) -> std::optional<ar::Frame> {
        if (n == 1) throw Error("is covered", "lens", "Take the cap off");
        if (n == 2) throw std::runtime_error("a library's words");
        return noisy(t, n);
      },
      4);
  using F = ar::PictureFault;
  EXPECT_EQ(told.faults, (std::vector<F>{F::none, F::gone, F::gone, F::none}));
  EXPECT_NE(told.words[1].find("Take the cap off"), std::string::npos);
  EXPECT_EQ(told.words[2], "the camera is gone: look at its cable");
}

TEST(CameraActivity, WantOfMemoryIsNotTheCameras) {
  const auto hungry = [](std::int64_t, std::uint64_t) -> std::optional<ar::Frame> {
    throw cv::Exception(cv::Error::StsNoMem, "", "", "", 0);
  };
  EXPECT_THROW(tellOf(hungry, 1), std::bad_alloc);
}

TEST(CameraActivity, BlackFrozenAndForeignPicturesAreTold) {
  using F = ar::PictureFault;
  const auto black = tellOf(
      [](std::int64_t t, std::uint64_t n) {
        ar::Frame frame = noisy(t, n);
        if (n > 0) frame.image /= 20;
        return frame;
      },
      2);
  EXPECT_EQ(black.faults, (std::vector<F>{F::none, F::black}));
  const auto frozen = tellOf(
      [](std::int64_t t, std::uint64_t n) { return noisy(t, std::min<std::uint64_t>(n, 3)); }, 20);
  EXPECT_EQ(frozen.faults[3], F::none);
  EXPECT_EQ(frozen.faults.back(), F::frozen);
  const auto foreign = tellOf(
      [](std::int64_t t, std::uint64_t n) {
        ar::Frame frame = noisy(t, n);
        if (n > 0) frame.image = frame.image(cv::Rect(0, 0, 32, 32)).clone();
        return frame;
      },
      2);
  EXPECT_EQ(foreign.faults[1], F::wrong_size);
  const auto ended = tellOf(
      [](std::int64_t t, std::uint64_t n) -> std::optional<ar::Frame> {
        return n == 2 ? std::nullopt : std::optional(noisy(t, n));
      },
      10);
  EXPECT_EQ(ended.faults, (std::vector<F>{F::none, F::none, F::ended}));
  for (const auto* told : {&black, &frozen, &foreign, &ended}) EXPECT_NE(told->words.back(), "");
}

TEST(CameraWords, SilenceIsTold) {
  EXPECT_NE(cameraTrouble(nullptr, 0), "");
  CameraView view;
  view.tracking = ar::TrackState::tracked;
  EXPECT_EQ(cameraTrouble(&view, kSecond), "");
  EXPECT_NE(cameraTrouble(&view, 2 * kSecond), "");
}

/// A model stands for camera and detector: its points are those of the exposure, and what follows
/// from them is visible as late as a picture's.
TEST(CameraActivity, PointsOfAModelTakeThePlaceOfPictures) {
  const auto executive = makeVirtualExecutive();
  Bus bus(TimeMode::virtual_time);
  const auto board = ar::makeBoard(ar::TagGridSpec{});
  const calibration::CameraModel camera{640, 480, 600, 600, 320, 240, {}, 0};
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(2.6, Vec3::UnitX()).toRotationMatrix();
  X.translation() = Vec3(0, 0, 0.5);
  CameraActivity::Settings settings{kPeriod, kLatency, TimeMode::virtual_time};
  std::vector<std::int64_t> asked;
  settings.finder = [&](std::int64_t now, std::uint64_t number) {
    EXPECT_EQ(number, asked.size());
    asked.push_back(now);
    std::vector<ar::BoardPoint> points;
    if (number != 2)
      for (int id = 0; id < 24; ++id)
        for (const Vec3& p_W : ar::tagCorners({}, id))
          points.push_back({p_W, camera.project(X * p_W)});
    return points;
  };
  CameraActivity activity(bus, {}, *board, camera, settings);
  std::vector<CameraView> seen;
  Doing reader("reader", [&](std::int64_t now) {
    const CameraView* view = bus.camera_to_scene.read(now);
    if (view && (seen.empty() || seen.back().number != view->number)) {
      EXPECT_EQ(now, view->t_exposure_ns + kLatency);
      seen.push_back(*view);
    }
    return seen.size() == 4 ? kNever : now + kMillisecond;
  });
  executive->add(activity, {3, false, false});
  executive->add(reader, {4, false, false});
  bool stopped = false;
  Doing end("end", [&](std::int64_t now) {
    if (now > 6 * kPeriod) executive->stop(), stopped = true;
    return stopped ? kNever : now + kPeriod;
  });
  executive->add(end, {5, false, false});
  executive->run();
  ASSERT_EQ(seen.size(), 4u);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(asked[i], std::int64_t(i) * kPeriod);
    EXPECT_FALSE(seen[i].picture);
    EXPECT_EQ(seen[i].fault, ar::PictureFault::none);
    EXPECT_EQ(seen[i].pose.has_value(), i != 2);
    EXPECT_EQ(seen[i].tracking, i == 2 ? ar::TrackState::coasting : ar::TrackState::tracked);
    ASSERT_TRUE(seen[i].X_CW);
    EXPECT_LT((seen[i].X_CW->translation() - X.translation()).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace palpa::runtime
