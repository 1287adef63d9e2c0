#include "apps/link/igtl/tracker_client.h"

#include <gtest/gtest.h>

#include <limits>

#include "anatomy/base/error.h"
#include "apps/link/igtl/conventions.h"
#include "apps/runtime/camera_activity.h"
#include "apps/runtime/camera_trouble.h"
#include "library_peer.h"

/// Poses from a PLUS server, played by the library's own server on loopback; the session's time is
/// the test's.
namespace palpa::igt {
namespace {

using igt_test::LibraryServer;
using igt_test::withMetadata;
using runtime::TrackedPose;

using runtime::kMillisecond;
const Pose kX_KR =
    makePose(Eigen::AngleAxisd(2.9, Vec3(1, 0.1, 0.2).normalized()).toRotationMatrix(),
             Vec3(0.02, -0.03, 0.5));
const Pose kX_CK =
    makePose(Eigen::AngleAxisd(0.3, Vec3::UnitY()).toRotationMatrix(), Vec3(0.01, 0.05, -0.02));
const Pose kX_RW = makePose(Mat3::Identity(), Vec3(-0.1, 0, 0));

struct HandClock final : runtime::Clock {
  std::int64_t t_ns = runtime::kSecond;
  std::int64_t now() const noexcept override { return t_ns; }
};

class IgtlTracker : public ::testing::Test {
 protected:
  static TrackerSettings settings(int port) {
    return {"localhost", static_cast<std::uint16_t>(port), "ReferenceToCamera", kX_CK, kX_RW, 0,
            0.015};
  }
  void make(const TrackerSettings& settings) {
    client_ = std::make_unique<TrackerClient>(settings, clock_, poses_);
  }
  /// Steps, a step every `ms` of session time, until `done` or for that many steps.
  template <class F>
  bool stepUntil(F done, int steps = 200, int ms = 5) {
    for (int i = 0; i < steps && !done(); ++i, clock_.t_ns += ms * kMillisecond)
      client_->step(clock_.t_ns);
    return done();
  }
  void together() {
    make(settings(server_.port()));
    client_->step(clock_.t_ns);
    ASSERT_TRUE(server_.accept(2000));
    ASSERT_TRUE(stepUntil([&] { return client_->counts().connections == 1; }));
  }
  bool hears(std::uint64_t poses) {
    return stepUntil([&] { return client_->counts().poses >= poses; });
  }
  static Bytes transform(const Pose& X = kX_KR) {
    return transformMessage("ReferenceToCamera", toWire(X), 5);
  }

  HandClock clock_;
  runtime::EventQueue<TrackedPose> poses_{16};
  LibraryServer server_;
  std::unique_ptr<TrackerClient> client_;
};

TEST_F(IgtlTracker, TransformBecomesTheCamerasPose) {
  together();
  server_.send(transform());
  ASSERT_TRUE(hears(1));
  TrackedPose pose;
  ASSERT_TRUE(poses_.pop(&pose));
  EXPECT_TRUE(pose.X_CW.isApprox(kX_CK * kX_KR * kX_RW, 1e-6));
  EXPECT_NEAR(static_cast<double>(clock_.t_ns - pose.t_ns), 15e6, 30e6) << "arrival less latency";
  EXPECT_LT(pose.t_ns, clock_.t_ns);
}

TEST_F(IgtlTracker, PoseComesOutOfTrackingDataAsWellAndOtherNamesAreLeft) {
  together();
  server_.send(transformMessage("StylusToReference", toWire(kX_CK), 5));
  server_.send(trackingMessage(
      "PLUS", {{"StylusToReference", toWire(kX_CK)}, {"ReferenceToCamera", toWire(kX_KR)}}, 5));
  ASSERT_TRUE(hears(1));
  TrackedPose pose;
  ASSERT_TRUE(poses_.pop(&pose));
  EXPECT_TRUE(pose.X_CW.isApprox(kX_CK * kX_KR * kX_RW, 1e-6));
  EXPECT_FALSE(poses_.pop(&pose));
}

TEST_F(IgtlTracker, TrackingDataAreAskedForWhereTheStationSaysSo) {
  TrackerSettings asks = settings(server_.port());
  asks.tracking_ms = 25;
  make(asks);
  client_->step(clock_.t_ns);
  ASSERT_TRUE(server_.accept(2000));
  ASSERT_TRUE(stepUntil([&] { return client_->counts().connections == 1; }));
  server_.peer().SetReceiveTimeout(2000);
  Bytes request(kHeaderSize + 36);
  ASSERT_EQ(server_.peer().Receive(request.data(), static_cast<int>(request.size())),
            static_cast<int>(request.size()));
  EXPECT_EQ(readHeader(View(request).first<kHeaderSize>())->type, "STT_TDATA");
  EXPECT_EQ(readTrackingRequest(View(request).subspan(kHeaderSize))->resolution_ms, 25);
}

TEST_F(IgtlTracker, WhatPlusCallsNotOkIsNotUsed) {
  together();
  for (const char* status : {"OUT_OF_VIEW", "MISSING", "OUT_OF_VOLUME", "UNKNOWN", ""})
    server_.send(withMetadata(transform(), {{"TransformStatus", status}}));
  server_.send(withMetadata(transform(), {{"TransformValid", "false"}, {"TransformStatus", "OK"}}));
  server_.send(
      withMetadata(trackingMessage("TDATA_1Elem", {{"ReferenceToCamera", toWire(kX_KR)}}, 5),
                   {{"ReferenceToCameraStatus", "OUT_OF_VIEW"}}));
  server_.send(withMetadata(transform(), {{"TransformStatus", "OK"}, {"TransformValid", "true"}}));
  ASSERT_TRUE(hears(1));
  EXPECT_EQ(client_->counts().unusable, 7u);
}

TEST_F(IgtlTracker, LongNameIsFoundInTheMetadataOrByItsBeginning) {
  TrackerSettings longer = settings(server_.port());
  longer.transform = "OperatingTableToHeadCamera";
  make(longer);
  client_->step(clock_.t_ns);
  ASSERT_TRUE(server_.accept(2000));
  server_.send(
      transformMessage("OperatingTableToHead", toWire(kX_KR), 5));  // cut: a device's name holds 20
  server_.send(withMetadata(transformMessage("OperatingTableToHead", toWire(kX_KR), 5),
                            {{"IGTL_DEVICE_NAME", "OperatingTableToHeadCamera"}}));
  server_.send(withMetadata(transformMessage("OperatingTableToHead", toWire(kX_KR), 5),
                            {{"IGTL_DEVICE_NAME", "OperatingTableToHeadband"}}));
  server_.send(transformMessage("OperatingTableToHead", toWire(kX_KR), 5));
  ASSERT_TRUE(hears(3));
  stepUntil([] { return false; }, 5);
  EXPECT_EQ(client_->counts().poses, 3u);
}

TEST_F(IgtlTracker, GarbageIsDroppedAndCounted) {
  together();
  Mat4 nan = toWire(kX_KR), scaled = toWire(kX_KR);
  nan(0, 3) = std::numeric_limits<double>::quiet_NaN();
  scaled.topLeftCorner<3, 3>() *= 2;
  server_.send(transformMessage("ReferenceToCamera", nan, 5));
  server_.send(transformMessage("ReferenceToCamera", scaled, 5));
  server_.send(transformMessage("ReferenceToCamera", Mat4::Zero(), 5));
  Bytes damaged = transform();
  damaged[kHeaderSize + 20] ^= 4;
  server_.send(damaged);
  server_.send(stringMessage("Text", "of no interest", 5));
  server_.send(transform());
  ASSERT_TRUE(hears(1));
  const TrackerCounts counts = client_->counts();
  EXPECT_EQ(counts.not_rigid, 3u);
  EXPECT_EQ(counts.damaged, 1u);
  EXPECT_EQ(counts.skipped, 1u);
  EXPECT_EQ(counts.connections, 1u) << "none of it ends the connection";
}

TEST_F(IgtlTracker, RandomBytesEndTheConnectionAndAnotherIsMade) {
  together();
  server_.send(Bytes(4000, 0xa5));
  ASSERT_FALSE(stepUntil([] { return false; }, 100));
  ASSERT_TRUE(server_.accept(2000)) << "it has tried again";
  server_.send(transform());
  EXPECT_TRUE(hears(1));
  EXPECT_EQ(client_->counts().connections, 2u);
}

TEST_F(IgtlTracker, LossInTheMiddleOfAMessageAndAServerThatComesBack) {
  auto first = std::make_unique<os::TcpListener>(
      "127.0.0.1", 0);  // the library's server waits a minute before it takes a port again
  const std::uint16_t port = first->port();
  make(settings(port));
  os::TcpSocket peer;
  ASSERT_TRUE(stepUntil([&] { return peer.open() || (peer = first->accept()).open(); }));
  Bytes half = transform();
  half.resize(80);
  peer.send(half);
  stepUntil([] { return false; }, 3);
  peer.close();
  first.reset();
  ASSERT_FALSE(stepUntil([&] { return client_->counts().poses > 0; }, 200, 50))
      << "ten seconds without a server";
  os::TcpListener again("127.0.0.1", port);
  ASSERT_TRUE(stepUntil([&] { return peer.open() || (peer = again.accept()).open(); }, 100, 50))
      << "within the longest pause";
  peer.send(transform());
  EXPECT_TRUE(hears(1));
  EXPECT_EQ(client_->counts().damaged, 0u) << "the half of before is forgotten";
}

TEST_F(IgtlTracker, TriesComeSlowerWhileNobodyIsThere) {
  const int port = server_.port();
  server_.stop();
  make(settings(port));
  int tries = 0;
  std::int64_t last = 0;
  for (std::int64_t end = clock_.t_ns + 30 * runtime::kSecond; clock_.t_ns < end;) {
    const std::int64_t next = client_->step(clock_.t_ns);
    if (next == clock_.t_ns && clock_.t_ns - last > 100 * kMillisecond) {  // not waiting: it tries
      ++tries;
      last = clock_.t_ns;
    }
    clock_.t_ns = std::max(next, clock_.t_ns + kMillisecond);
  }
  EXPECT_GE(tries, 8) << "0, 0.25, 0.75, 1.75, 3.75, 7.75, ... every 4 s";
  EXPECT_LE(tries, 12);
}

TEST_F(IgtlTracker, SilenceEndsTheConnection) {
  together();
  server_.send(transform());
  ASSERT_TRUE(hears(1));
  stepUntil([] { return false; }, 70, 100);  // 7 s
  EXPECT_TRUE(server_.accept(2000)) << "a cable that was pulled says nothing: try anew";
}

TEST_F(IgtlTracker, MarkersOutOfSightForLongAreFoundAgainAtOnce) {
  together();
  for (int again = 1; again <= 6; ++again) {  // a sender that says nothing of what it does not see
    stepUntil([&] { return client_->counts().connections > static_cast<std::uint64_t>(again); }, 80,
              100);
    ASSERT_TRUE(server_.accept(0)) << "try " << again << " came within 8 s of session time";
  }
  server_.send(transform());
  EXPECT_TRUE(hears(1));
}

TEST_F(IgtlTracker, PromisedBodiesThatNeverComeEndInAnotherTry) {
  together();
  server_.send(igt_test::headerOf("TRANSFORM", ~0ull));
  stepUntil([&] { return client_->counts().connections == 2; });
  ASSERT_TRUE(server_.accept(2000)) << "no such size: at once";
  server_.send(igt_test::headerOf("IMAGE", 1ull << 30));
  server_.send(transform());  // a part of that picture
  ASSERT_FALSE(hears(1));
  stepUntil([&] { return client_->counts().connections == 3; }, 80, 100);
  ASSERT_TRUE(server_.accept(2000)) << "no message in 5 s";
  server_.send(transform());
  EXPECT_TRUE(hears(1));
}

TEST_F(IgtlTracker, LaterVersionsAndHalfMessagesAreNoPoses) {
  together();
  Bytes later = transform();
  later[1] = 3;
  server_.send(later);
  const Bytes whole = transform();
  server_.send(Bytes(whole.begin(), whole.begin() + 60));
  EXPECT_FALSE(stepUntil([&] { return client_->counts().poses > 0; }, 20));
  EXPECT_EQ(client_->counts().skipped, 1u);
  server_.send(Bytes(whole.begin() + 60, whole.end()));
  EXPECT_TRUE(hears(1)) << "the rest came later";
}

TEST_F(IgtlTracker, QueueThatNobodyEmptiesStopsNothing) {
  together();
  for (int i = 0; i < 500; ++i) server_.send(transform());
  EXPECT_TRUE(hears(500));
  EXPECT_GT(poses_.overflows(), 400u);
}

TEST(IgtlTrackerSettings, UnknownHostAndMissingNameAreRefused) {
  HandClock clock;
  runtime::EventQueue<TrackedPose> poses{4};
  EXPECT_THROW(TrackerClient({"no.such.host.invalid", 1, "AToB", {}, {}, 0, 0}, clock, poses),
               UsageError);
  EXPECT_THROW(TrackerClient({"127.0.0.1", 1, "", {}, {}, 0, 0}, clock, poses), UsageError);
}

/// The camera's activity with blank pictures, whose place a tracking system tells.
TEST(IgtlTrackedCamera, PoseIsTakenAtTheExposureAndGoesStale) {
  runtime::Bus bus(runtime::TimeMode::real);
  const auto board = ar::makeBoard("tags:2x2:0.030:0.0075");
  const calibration::CameraModel camera{64, 64, 60, 60, 31.5, 31.5, {}, 0};
  runtime::CameraActivity::Settings settings{10 * kMillisecond, 0, runtime::TimeMode::real};
  settings.tracked = runtime::CameraActivity::Tracking{0.3e-3, 2e-3, 0.1};
  runtime::CameraActivity activity(
      bus,
      [](std::int64_t now, std::uint64_t number) -> runtime::CameraActivity::Exposure {
        return [=](const cv::Rect&) -> std::optional<ar::Frame> {
          ar::Frame frame;
          frame.t_exposure_ns = now;
          frame.image =
              cv::Mat(64, 64, CV_8UC1, cv::Scalar(100 + static_cast<double>(number % 100)));
          return frame;
        };
      },
      *board, camera, settings);
  activity.step(0);
  const runtime::CameraView* view = bus.camera_to_task.read(0);
  ASSERT_TRUE(view);
  EXPECT_FALSE(view->X_CW);
  EXPECT_NE(runtime::cameraTrouble(view, 0).find("tracking system"), std::string::npos);
  const Pose X_CW = kX_CK * kX_KR * kX_RW;
  std::int64_t t = kMillisecond;
  for (; t < 500 * kMillisecond; t += 20 * kMillisecond) {
    bus.tracker_to_camera.push({t, X_CW});
    activity.step(t + 10 * kMillisecond);
  }
  view = bus.camera_to_task.read(t);
  ASSERT_TRUE(view->X_CW);
  EXPECT_LT((view->X_CW->translation() - X_CW.translation()).norm(), 1e-4);
  EXPECT_EQ(view->tracking, ar::TrackState::tracked);
  EXPECT_EQ(runtime::cameraTrouble(view, t), "");
  const std::int64_t last = t - 20 * kMillisecond;
  activity.step(last + 90 * kMillisecond);
  EXPECT_TRUE(bus.camera_to_task.read(t)->X_CW) << "predicted for 100 ms";
  activity.step(last + 110 * kMillisecond);
  view = bus.camera_to_task.read(t);
  EXPECT_FALSE(view->X_CW) << "then stale";
  EXPECT_EQ(view->tracking, ar::TrackState::lost);
  EXPECT_NE(
      runtime::cameraTrouble(view, last + 110 * kMillisecond).find("tracking system has lost"),
      std::string::npos);
}

}  // namespace
}  // namespace palpa::igt
