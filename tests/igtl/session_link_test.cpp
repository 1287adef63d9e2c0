#include "apps/link/igtl/session_link.h"

#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/link/igtl/conventions.h"
#include "apps/link/igtl/tracker_client.h"
#include "apps/runtime/executive.h"
#include "library_peer.h"

/// What a session tells, and all of it in threads.
namespace palpa::igt {
namespace {

using igt_test::Got;
using igt_test::lastOf;
using igt_test::LibraryClient;

constexpr std::int64_t kStart_ns = 1'788'000'000'000'000'000;
const Pose kX_WD =
    makePose(Eigen::AngleAxisd(1.1, Vec3::UnitZ()).toRotationMatrix(), Vec3(0.1, 0.2, 0.3));
const Pose kX_ET =
    makePose(Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix(), Vec3(0, 0, 0.06));

IgtlLinkSetup setup() {
  IgtlLinkSetup setup;
  setup.utc_start_ns = kStart_ns;
  setup.X_WD = kX_WD;
  setup.X_ET = kX_ET;
  return setup;
}

runtime::ToolState toolAt(std::int64_t t_ns) {
  runtime::ToolState tool;
  tool.t_ns = t_ns;
  tool.X_DT = pack(makePose(Mat3::Identity(), Vec3(1e-12 * static_cast<double>(t_ns), 0.02,
                                                   -0.03)));  // a millimetre in a second
  tool.f_contact_D = {1, 2, 3};
  tool.f_command_D = {0.5, 0, 0};
  tool.depth = 0.0125;
  tool.phase = haptics::NeedlePhase::indenting;
  tool.tissue = Tissue::muscle;
  tool.homed = true;
  return tool;
}

class IgtlSessionLink : public ::testing::Test {
 protected:
  std::vector<Got> told(const std::vector<runtime::EvidenceMessage>& evidence = {}) {
    LibraryClient client(link_.server().port());
    link_.step(0);
    for (const auto& message : evidence) bus_.recorder_to_link.push(message);
    for (std::int64_t t = 10; t <= 40; t += 10) link_.step(t * runtime::kMillisecond);
    return client.all();
  }
  runtime::Bus bus_{runtime::TimeMode::real};
  IgtlLink link_{setup(), bus_};
};

TEST_F(IgtlSessionLink, ToolAndForcesAreToldOnTheTable) {
  const runtime::ToolState tool = toolAt(5'000'000);
  bus_.haptic_to_link.publish(tool, 0);
  const auto messages = told();
  const auto tip = lastOf(messages, "NeedleTipToReference"),
             needle = lastOf(messages, "NeedleToReference"),
             fixed = lastOf(messages, "NeedleTipToNeedle");
  ASSERT_TRUE(tip && needle && fixed);
  EXPECT_LT((tip->X_mm - toWire(kX_WD * unpack(tool.X_DT))).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((needle->X_mm * fixed->X_mm - tip->X_mm).cwiseAbs().maxCoeff(), 1e-3) << "names chain";
  EXPECT_NEAR(static_cast<double>(tip->utc_ns - kStart_ns - 5'000'000), 0, 20)
      << "when the tick was";
  const auto contact = lastOf(messages, "NeedleContactForce"),
             device = lastOf(messages, "NeedleDeviceForce"),
             depth = lastOf(messages, "NeedleDepth");
  ASSERT_TRUE(contact && device && depth);
  const Vec3 f_W = kX_WD.linear() * Vec3(1, 2, 3);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(contact->values.at(static_cast<std::size_t>(i)), f_W[i], 1e-12);
  EXPECT_NEAR(depth->values.at(0), 12.5, 1e-12);
  const auto phase = lastOf(messages, "PalpaPhase");
  ASSERT_TRUE(phase);
  EXPECT_EQ(
      nlohmann::json::parse(phase->text),
      (nlohmann::json{{"trial", 0}, {"phase", "indenting"}, {"tissue", name(Tissue::muscle)}}));
}

TEST(IgtlTwoTools, EachHasItsNamesAndItsDevice) {
  runtime::Bus bus{runtime::TimeMode::real};
  IgtlLinkSetup two = setup();
  two.tool = "Probe";
  two.second_X_WD = makePose(Mat3::Identity(), Vec3(0, 0, 0.4));
  two.X_WP = makePose(Mat3::Identity(), Vec3(0, 0.24, 0.05));
  IgtlLink link(two, bus);
  LibraryClient client(link.server().port());
  bus.haptic_to_link.publish(toolAt(0), 0);
  bus.second_to_link.publish(toolAt(0), 0);
  for (std::int64_t t = 0; t <= 40; t += 10) link.step(t * runtime::kMillisecond);
  const auto messages = client.all();
  const auto first = lastOf(messages, "ProbeTipToReference"),
             tip = lastOf(messages, "Probe2TipToReference"),
             second = lastOf(messages, "Probe2ToReference"),
             fixed = lastOf(messages, "Probe2TipToProbe2");
  ASSERT_TRUE(first && tip && second && fixed) << "20 characters are not cut";
  EXPECT_LT((first->X_mm - toWire(kX_WD * unpack(toolAt(0).X_DT))).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((tip->X_mm - toWire(*two.second_X_WD * unpack(toolAt(0).X_DT))).cwiseAbs().maxCoeff(),
            1e-4);
  EXPECT_LT((second->X_mm * fixed->X_mm - tip->X_mm).cwiseAbs().maxCoeff(), 1e-3) << "names chain";
  EXPECT_TRUE(lastOf(messages, "Probe2ContactForce"));
  const auto phantom = lastOf(messages, "PhantomToReference");
  ASSERT_TRUE(phantom);
  EXPECT_LT((phantom->X_mm - toWire(*two.X_WP)).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_F(IgtlSessionLink, WhatIsNotKnownIsNotTold) {
  runtime::ToolState tool = toolAt(0);
  tool.homed = false;
  bus_.haptic_to_link.publish(tool, 0);
  bus_.camera_to_link.publish({0, std::nullopt}, 0);
  const auto messages = told();
  EXPECT_FALSE(lastOf(messages, "NeedleTipToReference"));
  EXPECT_FALSE(lastOf(messages, "NeedleContactForce"));
  EXPECT_FALSE(lastOf(messages, "CameraToReference"));
  EXPECT_TRUE(lastOf(messages, "ReferenceToRas")) << "this is known always";
}

TEST_F(IgtlSessionLink, CameraIsToldWhileItIsFresh) {
  const Pose X_CW =
      makePose(Eigen::AngleAxisd(3, Vec3::UnitX()).toRotationMatrix(), Vec3(0, 0, 0.5));
  bus_.camera_to_link.publish({-100'000'000, X_CW}, 0);
  auto camera = lastOf(told(), "CameraToReference");
  ASSERT_TRUE(camera);
  EXPECT_LT((camera->X_mm - toWire(X_CW.inverse())).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_NEAR(static_cast<double>(camera->utc_ns - kStart_ns + 100'000'000), 0, 20);
  bus_.camera_to_link.publish({-600'000'000, X_CW}, 0);
  EXPECT_FALSE(lastOf(told(), "CameraToReference"));
}

TEST_F(IgtlSessionLink, EventsAreToldAsTheyWereRecorded) {
  bus_.haptic_to_link.publish(toolAt(0), 0);
  const auto messages =
      told({runtime::TrialHeader{3, 1, 1, "scored", true, 1},
            runtime::Event{2'000'000, 3, "puncture", "The \"skin\" is punctured", 4.5}});
  const auto event = lastOf(messages, "PalpaEvent");
  ASSERT_TRUE(event);
  EXPECT_EQ(nlohmann::json::parse(event->text),
            (nlohmann::json{{"kind", "puncture"},
                            {"trial", 3},
                            {"text", "The \"skin\" is punctured"},
                            {"value", 4.5}}));
  EXPECT_NEAR(static_cast<double>(event->utc_ns - kStart_ns - 2'000'000), 0, 20);
  EXPECT_EQ(nlohmann::json::parse(lastOf(messages, "PalpaPhase")->text).at("trial"), 3);
  const auto ended = told({runtime::TrialEnd{3, 5, "success", "", ""}});
  EXPECT_EQ(nlohmann::json::parse(lastOf(ended, "PalpaEvent")->text).at("text"), "success");
  EXPECT_EQ(nlohmann::json::parse(lastOf(ended, "PalpaPhase")->text).at("trial"), 0);
}

/// Plays HAPTIC: publishes at 1 kHz, counts how late it was.
class Loop final : public runtime::Activity {
 public:
  Loop(runtime::Bus& bus, runtime::Executive& executive) : bus_(bus), executive_(executive) {}
  const char* name() const override { return "haptic"; }
  std::int64_t step(std::int64_t now_ns) override {
    bus_.haptic_to_link.publish(toolAt(now_ns), now_ns);
    bus_.recorder_to_link.push(runtime::Event{now_ns, 1, "note", "a tick", 0});
    if (now_ns > 1'500'000'000) executive_.stop();
    return now_ns + runtime::kMillisecond;
  }

 private:
  runtime::Bus& bus_;
  runtime::Executive& executive_;
};

/// Plays the camera: takes what the tracker says.
class Taker final : public runtime::Activity {
 public:
  explicit Taker(runtime::Bus& bus) : bus_(bus) {}
  const char* name() const override { return "camera"; }
  std::int64_t step(std::int64_t now_ns) override {
    for (runtime::TrackedPose pose; bus_.tracker_to_camera.pop(&pose); ++taken) last = pose;
    return now_ns + 10 * runtime::kMillisecond;
  }
  int taken = 0;
  runtime::TrackedPose last;

 private:
  runtime::Bus& bus_;
};

TEST(IgtlThreads, SessionIsServedAndFollowsATrackerAtOnce) {
  const auto executive = runtime::makeRealExecutive();
  runtime::Bus bus(runtime::TimeMode::real);
  Loop loop(bus, *executive);
  Taker taker(bus);
  IgtlLink link(setup(), bus);
  // Two sessions in one: it follows the needle that it serves itself.
  TrackerClient tracker({"127.0.0.1", link.server().port(), "NeedleTipToReference",
                         Pose::Identity(), Pose::Identity(), 0, 0},
                        executive->clock(), bus.tracker_to_camera);
  std::vector<Got> heard;
  std::thread slicer([&, port = link.server().port()] {
    LibraryClient client(port);
    client.startTracking(20, "Reference");
    while (auto got = client.next(1000)) heard.push_back(std::move(*got));  // until the link goes
    client.close();
  });
  executive->add(loop, {1, false, false});
  executive->add(link, {9, false, false});
  executive->add(tracker, {0, false, false});
  executive->add(taker, {3, false, false});
  executive->run();
  EXPECT_GT(taker.taken, 20) << "at 50 Hz for more than a second";
  EXPECT_NEAR(taker.last.X_CW.translation().y(),
              (kX_WD * unpack(toolAt(taker.last.t_ns).X_DT)).translation().y(), 2e-4);
  EXPECT_GE(link.server().everConnected(), 2u);
  slicer.join();
  std::int64_t last = 0;
  for (const Got& m : heard) {
    EXPECT_TRUE(m.whole) << m.type << " " << m.device << ", " << &m - heard.data() << " of "
                         << heard.size();
    if (m.device != "NeedleTipToReference") continue;
    EXPECT_GE(m.utc_ns, last) << "in the order of time";
    last = m.utc_ns;
    const Mat4 X_mm = toWire(kX_WD * unpack(toolAt(m.utc_ns - kStart_ns).X_DT));
    EXPECT_LT((m.X_mm - X_mm).cwiseAbs().maxCoeff(), 2e-4) << "place and time belong together";
  }
  EXPECT_GT(igt_test::countOf(heard, "TDATA"), 15);
  EXPECT_TRUE(lastOf(heard, "PalpaEvent"));
}

}  // namespace
}  // namespace palpa::igt
