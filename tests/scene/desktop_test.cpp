#include "scene/window/desktop.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "scene/window/egl_devices.h"
#include "scene/window/gl_context.h"
#include "tests/support/complaint.h"

/// Where a window is to be, and by what is drawn, as a person says it.
namespace palpa::scene {
namespace {

const std::vector<Monitor> kTwo{{"DP-1", 0, 0, 1920, 1080, false},
                                {"HDMI-1", 1920, 0, 3840, 2160, true}};

TEST(Monitors, AreKnownByNumberFromTheLeftByNameAndAsThePrimaryOne) {
  EXPECT_EQ(monitorOf("", kTwo).name, "HDMI-1");
  EXPECT_EQ(monitorOf("1", kTwo).name, "DP-1");
  EXPECT_EQ(monitorOf("2", kTwo).name, "HDMI-1");
  EXPECT_EQ(monitorOf("DP-1", kTwo).name, "DP-1");
  const std::string words = palpa::test::complaint([] { monitorOf("3", kTwo); });
  EXPECT_TRUE(palpa::test::says(words, "1 (DP-1, 1920x1080), 2 (HDMI-1, 3840x2160)")) << words;
  EXPECT_THROW(monitorOf("", {}), UsageError);
}

TEST(Monitors, AWindowIsAsLargeAsWishedAndNoLargerThanItsMonitor) {
  const WindowPlace usual = fittedTo(kTwo[1], {});
  EXPECT_EQ(usual.width, 3072);
  EXPECT_EQ(usual.height, 1728);
  EXPECT_EQ(usual.monitor, "HDMI-1");
  EXPECT_FALSE(usual.full_screen);
  const WindowPlace large = fittedTo(kTwo[0], {2560, 900, true, "1"});
  EXPECT_EQ(large.width, 1920);
  EXPECT_EQ(large.height, 900);
  EXPECT_TRUE(large.full_screen);
  EXPECT_EQ(fittedTo({"small", 0, 0, 700, 300, true}, {}).height, 300);
}

std::vector<Gpu> cards() {
  return {{"NVIDIA RTX 4000/PCIe"}, {"/dev/dri/card1"}, {"llvmpipe", true}};
}

TEST(Gpus, AreChosenByNumber) {
  EXPECT_TRUE(gpuChoiceOf("auto", cards()).automatic);
  EXPECT_EQ(gpuChoiceOf("2", cards()).card, 2);
  EXPECT_FALSE(gpuChoiceOf("none", cards()).automatic);
  EXPECT_EQ(gpuChoiceOf("none", {}).card, 0);
  for (const char* word : {"3", "0", "-1", "", "1x", "NVIDIA"}) {
    const std::string words = palpa::test::complaint([&] { gpuChoiceOf(word, cards()); });
    EXPECT_TRUE(palpa::test::says(words, "1 (NVIDIA RTX 4000/PCIe), 2 (/dev/dri/card1)")) << words;
  }
  EXPECT_TRUE(palpa::test::says(palpa::test::complaint([] {
                                  gpuChoiceOf("1", {{"llvmpipe", true}});
                                }),
                                "none"));
}

/// What is drawn by the processor on demand is what Mesa draws by the processor.
TEST(Gpus, NoneIsTheProcessor) {
  drawBy("none");
  const auto context = makeGlContext(Display::offscreen, 64, 64, "");
  EXPECT_TRUE(drawsOnProcessor(context->renderer())) << context->renderer();
  drawBy("auto");
}

}  // namespace
}  // namespace palpa::scene
