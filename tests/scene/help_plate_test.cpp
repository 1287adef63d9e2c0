#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scene/offscreen.h"

/// What a person may ask for in the window, and what is said unasked.
namespace palpa::scene {
namespace {

class HelpFrame : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  HelpFrame()
      : view_(offscreen(), patient_,
              {GetParam().first, GetParam().second, FixedViews::three, true}) {
    state_.show_tool = false;
    state_.hud.phase = "Phase 1: puncture the skin";
  }
  Image frame() {
    view_.show(state_);
    return view_.capture();
  }
  double width() const { return GetParam().first; }
  double height() const { return GetParam().second; }
  static std::vector<KeyHelp> keys(int rows) {
    std::vector<KeyHelp> all(static_cast<std::size_t>(rows), {"Enter", "starts, continues"});
    all.back() = {"F5 to F8", "void: interrupted, technical fault, trainee stopped, other"};
    return all;
  }

  const anatomy::Patient patient_ = test::simplePatient();
  SceneView view_;
  SceneState state_;
};

TEST_P(HelpFrame, KeysLieInTheMiddleOfTheArViewAndGoWithoutATrace) {
  const Image before = frame();
  state_.help = keys(8);
  const Image asked = frame();
  const Blob plate = changed(before, asked, 60);
  EXPECT_GT(plate.count, 0.02 * width() * height());
  EXPECT_LT(plate.right, 0.71 * width()) << "the three views stay free";
  EXPECT_LT(plate.bottom, 0.92 * height()) << "a notice has its place";
  state_.help.clear();
  EXPECT_EQ(frame().pixels, before.pixels);
}

/// More keys than there is room for: the last ones are left out, and nothing stands over the edge.
TEST_P(HelpFrame, TooManyKeysStayWithinTheView) {
  const Image before = frame();
  state_.help = keys(200);
  const Blob plate = changed(before, frame(), 60);
  EXPECT_GT(plate.count, 0.02 * width() * height());
  EXPECT_LT(plate.right, 0.71 * width());
  EXPECT_LT(plate.bottom, 0.95 * height());
}

TEST_P(HelpFrame, AnAlarmIsSeenBesideThem) {
  state_.hud.notice = "EMERGENCY STOP: forces are off";
  state_.hud.alarm = true;
  state_.help = keys(12);
  const Image now = frame();
  const Blob red = blobOf(now, [&](int u, int v) {
    const Pixel p = at(now, u, v);
    return p.r > 150 && p.g < 50 && p.b < 50;
  });
  EXPECT_GT(red.count, 0.005 * width() * height());
}

INSTANTIATE_TEST_SUITE_P(Sizes, HelpFrame,
                         testing::Values(std::pair(640, 480), std::pair(1280, 720)));

/// What can be done now is said where nothing else is.
TEST_P(HelpFrame, WhatCanBeDoneGivesWayToANotice) {
  const Image nothing = frame();
  state_.hud.can_do = "P pauses, ? shows keys";
  const Blob said = changed(nothing, frame());
  EXPECT_GT(said.count, 100);
  EXPECT_GT(said.top, 0.8 * height());
  state_.hud.notice = "Lift first";
  const Image notice = frame();
  state_.hud.can_do = "";
  EXPECT_EQ(frame().pixels, notice.pixels);
}

}  // namespace
}  // namespace palpa::scene
