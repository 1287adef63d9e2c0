#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy/base/fonts.h"
#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

class HudFrame : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  HudFrame()
      : view_(offscreen(), patient_,
              {GetParam().first, GetParam().second, FixedViews::three, true}) {
    state_.hud.phase = "Phase 1: puncture the skin";
    state_.hud.force = "1.2 N";
    state_.hud.time = "0:31";
  }
  Image frame() {
    view_.show(state_);
    return view_.capture();
  }
  double width() const { return GetParam().first; }
  double height() const { return GetParam().second; }

  const anatomy::Patient patient_ = test::simplePatient();
  SceneView view_;
  SceneState state_;
};

TEST_P(HudFrame, SameWordsSamePicture) {
  const Image first = frame();
  EXPECT_EQ(frame().pixels, first.pixels);
}

/// Who judges by `wordPlates` judges what is seen.
TEST_P(HudFrame, PlatesAreWhereWordsChangeThePicture) {
  state_.show_tool = false;
  const Image with = frame();
  const std::vector<Rect> plates = view_.wordPlates();
  state_.hud = {};
  const Image without = frame();
  ASSERT_GE(plates.size(), 2u);
  for (const Rect& plate : plates)
    EXPECT_GT(blobOf(with,
                     [&](int u, int v) {
                       return plate.contains(u, height() - 1 - v) &&
                              difference(at(with, u, v), at(without, u, v)) > 20;
                     })
                  .count,
              30);
  const Blob beside = blobOf(with, [&](int u, int v) {
    return difference(at(with, u, v), at(without, u, v)) > 0 &&
           std::none_of(plates.begin(), plates.end(),
                        [&](const Rect& plate) { return plate.contains(u, height() - 1 - v); });
  });
  EXPECT_EQ(beside.count, 0);
}

TEST_P(HudFrame, ChangedReadingChangesTheLowerLeftCornerOnly) {
  const Image before = frame();
  state_.hud.force = "2.7 N";
  const Blob change = changed(before, frame());
  EXPECT_GT(change.count, 5);
  EXPECT_LT(change.right, 0.35 * width());
  EXPECT_GT(change.top, 0.70 * height());
}

/// Where no tool is in the way.
TEST_P(HudFrame, AlarmIsARedPlateInTheLowerMiddleOfTheArView) {
  state_.show_tool = false;
  const Image before = frame();
  state_.hud.notice = "Emergency stop: release the space bar and start again";
  state_.hud.alarm = true;
  const Image after = frame();
  const Blob red = blobOf(after, [&](int u, int v) {
    const Pixel p = at(after, u, v);
    return p.r > 150 && p.g < 50 && p.b < 50;
  });
  EXPECT_GT(red.count, 0.01 * width() * height());
  EXPECT_NEAR(red.u, 0.35 * width(), 0.03 * width());
  EXPECT_GT(red.top, 0.6 * height());
  EXPECT_LT(red.right, 0.7 * width());
  EXPECT_LT(changed(before, after).right, 0.7 * width());
}

TEST_P(HudFrame, AnAlarmIsSeenWhereverTheToolIs) {
  state_.hud.notice = "Emergency stop: release the space bar and start again";
  state_.hud.alarm = true;
  for (const double x : {-0.1, 0.0, 0.1})
    for (const double z : {-0.1, 0.0, 0.1}) {
      state_.X_AT = makePose(rotationWithZ(Vec3(0.2, 0.5, 0.3).normalized()), Vec3(x, 0, z));
      const Image now = frame();
      const Blob red = blobOf(now, [&](int u, int v) {
        const Pixel p = at(now, u, v);
        return p.r > 150 && p.g < 50 && p.b < 50;
      });
      EXPECT_GT(red.count, 0.01 * width() * height());
    }
}

class HudStrip : public HudFrame {};

TEST_P(HudStrip, LiesAtTheBottomOfTheArViewAndMovesOn) {
  state_.hud.force = state_.hud.time = "";  // they would move up
  const Image before = frame();
  state_.hud.timeline = Timeline{0.25, {{0.9, TickTone::bad}}, "0:02.5", " of 0:10.0", "x 1"};
  const Image quarter = frame();
  const Blob strip = changed(before, quarter);
  EXPECT_GT(strip.top, 0.85 * height());
  EXPECT_LT(strip.right, 0.7 * width());
  EXPECT_GT(strip.right - strip.left, 0.6 * width());
  state_.hud.timeline->at = 0.75;
  const Blob moved = changed(quarter, frame());
  EXPECT_GT(moved.count, 20);
  EXPECT_GT(moved.top, 0.85 * height());
  EXPECT_GT(moved.right - moved.left, 0.1 * width());
}

TEST_P(HudFrame, MarkStandsInTheTopRightCornerOfTheArView) {
  const Image before = frame();
  state_.hud.mark = "SIMULATED OPERATOR";
  const Image after = frame();
  const Blob amber = blobOf(after, [&](int u, int v) {
    const Pixel p = at(after, u, v);
    return difference(p, {255, 204, 77}) < 12 && difference(p, at(before, u, v)) > 30;
  });
  EXPECT_GT(amber.count, 100);
  EXPECT_LT(amber.bottom, 0.1 * height());
  EXPECT_GT(amber.left, 0.4 * width());
  EXPECT_LT(amber.right, 0.7 * width());
}

// On white the plate must be what separates the words from the picture.
/// Plain and bold, one after the other: each text is drawn with the font that has its letters.
TEST_P(HudFrame, KoreanWordsAreDrawnBesideOthers) {
  if (!isThere(fontOf("가"))) GTEST_SKIP() << "not installed: " << fontOf("가").package;
  state_.show_tool = false;
  const auto inkOf = [&](const std::string& notice, bool bold = false) {
    state_.hud = {};
    state_.hud.alarm = bold;
    const Image without = frame();
    state_.hud.notice = notice;
    const Image with = frame();
    return blobOf(with,
                  [&](int u, int v) {
                    return difference(at(with, u, v), at(without, u, v)) > 0 &&
                           at(with, u, v).r > 180;
                  })
        .count;
  };
  const int latin = inkOf("Vein reached. Trial ended"), korean = inkOf("정맥 도달. 시행 종료"),
            again = inkOf("Vein reached. Trial ended");
  EXPECT_GT(korean, latin / 3);
  EXPECT_EQ(again, latin);
  EXPECT_GT(inkOf("정맥 도달. 시행 종료", true), inkOf("Vein reached. Trial ended", true) / 3);
}

TEST_P(HudFrame, WordsStayLegibleOnAWhiteAndOnABlackPicture) {
  for (const std::uint8_t shade : {0, 255}) {
    const Image picture = plain(640, 480, shade);
    state_.picture = &picture;
    const Image now = frame();
    int light = 0, dark = 0;  // inside the phase's plate
    const int top = static_cast<int>(0.02 * height()), bottom = static_cast<int>(0.05 * height());
    for (int v = top; v < bottom; ++v) {
      for (int u = static_cast<int>(0.02 * width()); u < 0.18 * width(); ++u) {
        const Pixel p = at(now, u, v);
        light += p.g > 220;
        dark += p.g < 90;  // contrast of 7:1 with white, as for the WCAG's AAA
      }
    }
    EXPECT_GT(light, 40) << int(shade);
    EXPECT_GT(dark, 3 * light) << int(shade);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, HudFrame,
                         testing::Values(std::pair(1280, 720), std::pair(640, 480)),
                         [](const auto& size) { return "h" + std::to_string(size.param.second); });

/// Also as small as a film is made.
INSTANTIATE_TEST_SUITE_P(Sizes, HudStrip,
                         testing::Values(std::pair(1280, 720), std::pair(640, 480),
                                         std::pair(320, 240)),
                         [](const auto& size) { return "h" + std::to_string(size.param.second); });

}  // namespace
}  // namespace palpa::scene
