#include <gtest/gtest.h>

#include <algorithm>

#include "apps/session/mouse_hands.h"
#include "tests/headset/worn.h"

/// The controller as the hand at the needle, to the device's reading that the haptic loop takes.
namespace palpa::headset {
namespace {

/// The patient's frame lies as the head is level: OpenXR's x, -z, y are A's x, y, z, from a point
/// 0.45 m ahead and 0.25 m below the eyes.
Vec3 inPatient(const Vec3& p_xr) {
  return Vec3(p_xr.x(), -p_xr.z(), p_xr.y()) - Vec3(0, 0.45, -0.25);
}

TEST(Controller, MovesTheToolToAMillimetre) {
  Worn worn("eyes=64x64,64x64;rate=300");
  runtime::ChannelDevice device(haptics::DeviceCapabilities{}, runtime::TimeMode::real);
  trial::Channels channels;
  runtime::StopSwitch stop;
  session::MouseHandSetup setup;
  setup.X_DA = makePose(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                        {0.1, 0.2, -0.3});
  setup.X_ET = makePose(Eigen::AngleAxisd(-0.4, Vec3::UnitY()).toRotationMatrix(), {0.01, 0, 0.12});
  setup.anatomy = {Vec3::Zero(),  -Vec3::UnitY(), Vec3(0, 0.03, 0), 0.03,
                   Vec3::UnitX(), Vec3::UnitY(),  Vec3::UnitZ()};
  session::MouseHand hand(setup, device, channels, stop);
  std::int64_t now = 0;
  const auto tip = [&] {
    const haptics::DeviceReading reading = device.read(now);
    return Vec3(
        setup.X_DA.inverse() *
        (makePose(unpack(reading.q_DE).toRotationMatrix(), unpack(reading.p_DE)) * setup.X_ET)
            .translation());
  };
  HeldController last;
  worn.view->onHeld([&](const HeldController& held) {
    last = held;
    hand.hold(held, now);
  });
  double worst_moving = 0;
  const double pitch = -1.1;  // of the test runtime's hand, about x
  const Vec3 reach_xr(0, 0.10 * std::sin(pitch), -0.10 * std::cos(pitch));
  for (int frame = 0; frame < 450; ++frame) {
    ASSERT_TRUE(worn.view->wait(true));
    worn.view->show(Worn::bare());
    for (int tick = 0; tick < 11; ++tick) hand.step(now += runtime::kMillisecond);
    if (frame > 60) worst_moving = std::max(worst_moving, (tip() - last.X_AT.translation()).norm());
  }
  const Vec3 reached = tip();
  const double plunger = device.read(now).plunger;
  const test::XrReport report = worn.over();
  ASSERT_GE(report.hands.size(), 450u);
  EXPECT_LT((reached - inPatient(report.hands.back().p + reach_xr)).norm(), 1e-3);
  EXPECT_LT((reached - inPatient(report.hands.back().p + reach_xr)).norm(), 1e-5)
      << "in fact to rounding, once it stands";
  // It follows as the mouse does, 30 ms behind: 0.063 m/s of the circle by 0.03 s.
  EXPECT_LT(worst_moving, 1.2 * 0.03 * 0.07);
  EXPECT_NEAR(plunger, 1, 0.01);  // the trigger, slowly drawn
  expectClean(report, "controller");
}

TEST(Controller, EveryKnownKindIsBound) {
  for (const char* kind : {"khr/simple_controller", "oculus/touch_controller",
                           "htc/vive_controller", "microsoft/motion_controller"}) {
    Worn worn(std::string("eyes=64x64,64x64;controller=/interaction_profiles/") + kind);
    bool tracked = false;
    double trigger = 0;
    worn.view->onHeld([&](const HeldController& held) {
      tracked = held.tracked;
      trigger = held.plunger;
    });
    worn.show(20);
    EXPECT_TRUE(tracked) << kind;
    EXPECT_GT(trigger, 0) << kind;
    worn.view->pulse(0.05, 0.5);
    EXPECT_EQ(calls(worn.over(), "xrApplyHapticFeedback"), 1) << kind;
  }
}

TEST(Controller, LeftHandedPeopleHoldItInTheLeft) {
  HeadsetViewSetup setup = unhurried();
  setup.left_handed = true;
  Worn worn("eyes=64x64,64x64", 0.03, setup);
  bool tracked = false;
  worn.view->onHeld([&](const HeldController& held) { tracked |= held.tracked; });
  worn.show(5);
  EXPECT_FALSE(tracked);  // the test runtime has only a right hand
}

std::vector<HeldController> toldBy(const std::string& plan, bool may_place = true) {
  Worn worn("eyes=64x64,64x64;" + plan);
  std::vector<HeldController> told;
  worn.view->onHeld([&](const HeldController& held) { told.push_back(held); });
  for (int i = 0; i < 16; ++i) {
    EXPECT_TRUE(worn.view->wait(may_place || i < 2));
    worn.view->show(Worn::bare());
  }
  expectClean(worn.over(), plan);
  return told;
}

TEST(Controller, OneThatIsSwitchedOffOrOnlyGuessedIsNotTracked) {
  for (const char* fault : {"controller_off@8", "inferred@8"}) {
    const std::vector<HeldController> told = toldBy(std::string("fault=") + fault);
    ASSERT_EQ(told.size(), 16u);
    EXPECT_TRUE(told[5].tracked) << fault;
    EXPECT_FALSE(told[15].tracked) << fault;
  }
}

/// The head moves by 5 mm to the right from frame to frame. Placed anew, the patient is before it
/// again: the hand is then so much further left of him. While the tool is in him he stays, whatever
/// is asked.
TEST(Controller, ThePatientComesWhenAskedAndOnlyWhenHeMay) {
  const auto jump = [](const std::string& fault, bool may_place) {
    const std::vector<HeldController> told = toldBy("drift=5;fault=" + fault, may_place);
    Vec3 largest = Vec3::Zero();
    for (std::size_t i = 1; i < told.size(); ++i) {
      const Vec3 step = told[i].X_AT.translation() - told[i - 1].X_AT.translation();
      if (step.norm() > largest.norm()) largest = step;
    }
    return largest;
  };
  for (const char* fault : {"recentred@8", "menu_pressed@8"}) {
    const Vec3 step = jump(fault, true);
    EXPECT_NEAR(step.x(), -0.035, 0.006) << fault;  // 7 or 8 frames, and the hand's own millimetre
    EXPECT_LT(jump(fault, false).norm(), 2e-3) << fault;
  }
  EXPECT_LT(jump("stage_moved@8", true).norm(), 2e-3) << "the room's own origin is nothing to us";
  EXPECT_LT(jump("none@1", true).norm(), 2e-3);
}

TEST(Controller, TheStartButtonStarts) {
  const std::vector<HeldController> told =
      toldBy("controller=/interaction_profiles/oculus/touch_controller;fault=start_pressed@8");
  EXPECT_EQ(std::count_if(told.begin(), told.end(),
                          [](const HeldController& held) { return held.start; }),
            1);
}

/// A hand that takes over from a controller takes over where the needle is.
TEST(Controller, TheMouseTakesOverWhereItWas) {
  runtime::ChannelDevice device(haptics::DeviceCapabilities{}, runtime::TimeMode::real);
  trial::Channels channels;
  runtime::StopSwitch stop;
  session::MouseHandSetup setup;
  setup.X_DA = setup.X_ET = Pose::Identity();
  setup.anatomy = {Vec3::Zero(),  -Vec3::UnitY(), Vec3(0, 0.03, 0), 0.03,
                   Vec3::UnitX(), Vec3::UnitY(),  Vec3::UnitZ()};
  session::MouseHand hand(setup, device, channels, stop);
  std::int64_t now = runtime::kSecond;
  const auto settle = [&] {
    for (int i = 0; i < 500; ++i) hand.step(now += runtime::kMillisecond);
    return unpack(device.read(now).p_DE);
  };
  HeldController held{
      true, makePose(Eigen::AngleAxisd(0.8, Vec3::UnitX()).toRotationMatrix(), {0.05, 0.01, -0.02}),
      0.5, false};
  hand.hold(held, now);
  const Vec3 there = settle();
  EXPECT_LT((there - held.X_AT.translation()).norm(), 1e-5);
  held.tracked = false;
  hand.hold(held, now);
  EXPECT_LT((settle() - there).norm(), 1e-5) << "not seen, it stays";
  scene::ViewInput wheel;
  wheel.wheel = 3;
  hand.handle(wheel, now);
  EXPECT_NEAR((settle() - there).norm(), 0.003, 1e-4) << "a millimetre a notch from there on";
}

}  // namespace
}  // namespace palpa::headset
