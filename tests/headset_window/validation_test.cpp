#include <gtest/gtest.h>

#include <filesystem>

#include "anatomy/base/error.h"
#include "tests/headset/worn.h"

/// 500 frames under OpenXR's own core validation layer, in a context of GLX.
namespace palpa::headset {
namespace {

constexpr const char* kLayer =
    "/usr/share/openxr/1/api_layers/explicit.d/XrApiLayer_core_validation.x86_64-linux-gnu.json";

TEST(HeadsetValidation, FiveHundredFramesWithoutAnError) {
  if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  if (!std::filesystem::exists(kLayer))
    GTEST_SKIP() << "no core validation layer (package openxr-layer-corevalidation)";
  // The context decides the process's kind, and the display's is looked for first.
  const auto desktop = scene::makeGlContext(scene::Display::window, 320, 240, "Palpa headset test");
  Worn worn("eyes=160x128,160x128;rate=1000");
  const std::filesystem::path errors = worn.xr.folder() / "validation.txt";
  worn.view.reset();  // its report is written over
  setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
  setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
  setenv("XR_CORE_VALIDATION_FILE_NAME", errors.c_str(), 1);
  worn.view = std::make_unique<HeadsetView>(worn.patient, unhurried());
  worn.view->onHeld([&](const HeldController& held) {
    if (held.tracked && held.plunger > 0.5) worn.view->pulse(0.01, 0.5);
  });
  EXPECT_EQ(worn.show(500), 500);
  const test::XrReport report = worn.over();
  expectClean(report, "500 frames");
  for (const char* call : {"xrWaitFrame", "xrBeginFrame", "xrEndFrame"})
    EXPECT_GE(calls(report, call), 500) << call;
  EXPECT_EQ(calls(report, "xrWaitFrame"), calls(report, "xrEndFrame"));
  EXPECT_EQ(calls(report, "xrCreateSession"), calls(report, "xrDestroySession"));
  EXPECT_EQ(calls(report, "xrCreateSwapchain"), calls(report, "xrDestroySwapchain"));
  EXPECT_GT(calls(report, "xrApplyHapticFeedback"), 0);
  std::string said;
  std::ifstream file(errors);
  for (std::string line; std::getline(file, line);)
    if (line.find("VALID_DEBUG") == std::string::npos) said += line + "\n";  // that it is there
  EXPECT_EQ(said.find("VALID_"), std::string::npos) << said;
}

/// The layer does see what is wrong: otherwise its silence would say nothing.
TEST(HeadsetValidation, TheLayerIsThere) {
  if (!std::getenv("DISPLAY") || !std::filesystem::exists(kLayer))
    GTEST_SKIP() << "no display, or no core validation layer";
  const test::TestXr xr(PALPA_TEST_XR_JSON, "");
  setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
  const auto desktop = scene::makeGlContext(scene::Display::window, 320, 240, "Palpa headset test");
  desktop->native();  // current
  ar::GlBinding nothing;
  nothing.kind = ar::GlPlatform::egl;  // which the layer does not know
  try {
    ar::openHeadset(nothing);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("XR_ERROR_VALIDATION_FAILURE"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace palpa::headset
