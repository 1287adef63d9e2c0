#include <gtest/gtest.h>

#include "scene/window/egl_window.h"
#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

TEST(GlContext, ThisProgramExportsOurGlewInit) { EXPECT_TRUE(glewInitIsOurs()); }

TEST(GlContext, OffscreenNeedsNoDisplayAndHearsNobody) {
  EXPECT_FALSE(offscreen().interactive());
  EXPECT_NE(std::string(offscreen().describe()).find("EGL"), std::string::npos);
  const auto patient = test::simplePatient();
  SceneView view(offscreen(), patient, {320, 240, FixedViews::three, true});
  const ViewInput input = view.poll();
  EXPECT_FALSE(input.closed);
  EXPECT_TRUE(input.keys.empty());
}

TEST(GlContext, SaysWhatDraws) {
  EXPECT_FALSE(offscreen().renderer().empty());
  const auto fresh = makeGlContext(Display::offscreen, 320, 240, "nothing drawn yet");
  EXPECT_EQ(fresh->renderer(), offscreen().renderer());
  EXPECT_TRUE(drawsOnProcessor("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_FALSE(drawsOnProcessor("NVIDIA RTX 4000/PCIe"));
}

TEST(GlContext, WindowInAProcessThatDrawsWithEglIsRefusedInWords) {
  offscreen();
  try {
    makeGlContext(Display::window, 320, 240, "window");
    FAIL() << "GLX and EGL in one process";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("EGL"), std::string::npos);
  }
  EXPECT_FALSE(makeGlContext(Display::automatic, 320, 240, "either")->interactive());
}

TEST(GlContext, EmptyWindowIsAUsageError) {
  EXPECT_THROW(makeGlContext(Display::offscreen, 0, 240, ""), UsageError);
}

// Two contexts, their views alive at once, drawing in turn.
TEST(GlContext, TwoOffscreenContextsDoNotDisturbEachOther) {
  const auto other = makeGlContext(Display::offscreen, 320, 240, "other");
  const auto patient = test::simplePatient();
  const auto ball = test::spherePatient({0, 0, 0}, 0.02);
  SceneView a(offscreen(), patient, {320, 240, FixedViews::three, true});
  SceneState state;
  state.show_tool = false;
  a.show(state);
  const Image before = a.capture();
  SceneView b(*other, ball, {320, 240, FixedViews::three, true});
  b.show(state);
  EXPECT_GT(changed(before, b.capture()).count, 1000);
  a.show(state);
  EXPECT_EQ(a.capture().pixels, before.pixels);
}

TEST(SceneView, PatientWithoutOrgansOrLandmarksIsDrawnAsNothing) {
  const anatomy::Patient nobody;
  SceneView view(offscreen(), nobody, {320, 240, FixedViews::three, true});
  view.show({});
  EXPECT_EQ(view.capture().pixels.size(), 320u * 240u * 3u);
}

}  // namespace
}  // namespace palpa::scene
