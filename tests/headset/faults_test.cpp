#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/headset/worn.h"

/// Headsets that are not there, and headsets that go: a word each, and nothing left open.
namespace palpa::headset {
namespace {

std::string refusalOf(const std::string& plan) {
  try {
    Worn worn(plan);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

bool says(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

TEST(HeadsetFaults, WhatIsNotThereIsSaid) {
  const std::pair<const char*, const char*> kinds[] = {
      {"fault=runtime_failure", "does not work"},
      {"fault=no_headset", "no headset is connected"},
      {"fault=no_headset_kind", "drives no headset"},
      {"fault=one_eye", "two eyes"},
      {"fault=no_graphics", "graphics"},
      {"formats=1234", "format"},
      {"fault=no_opengl", "OpenGL"}};
  for (const auto& [plan, word] : kinds) {
    const std::string refusal = refusalOf(plan);
    EXPECT_TRUE(says(refusal, word)) << plan << ": " << refusal;
  }
}

TEST(HeadsetFaults, NoRuntimeIsSaid) {
  const anatomy::Patient patient = test::spherePatient(Vec3::Zero(), 0.03);
  const test::TestXr none("/nowhere/runtime.json", "");
  try {
    const HeadsetView view(patient, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(says(error.what(), "no OpenXR runtime is there")) << error.what();
  }
}

/// From the frame of the fault on nothing is shown, it is said why, and all goes back to the
/// runtime.
TEST(HeadsetFaults, WhatGoesIsSaidAndTheRestGoesOn) {
  const std::pair<const char*, const char*> kinds[] = {{"session_lost", "was lost"},
                                                       {"loss_pending", "was lost"},
                                                       {"instance_lost", "was lost"},
                                                       {"ended_there", "ended there"},
                                                       {"stuck_picture", "was lost"}};
  for (const auto& [fault, word] : kinds) {
    Worn worn(std::string("eyes=64x64,64x64;fault=") + fault + "@6");
    const int shown = worn.show(12);
    EXPECT_GE(shown, 5) << fault;
    EXPECT_LE(shown, 7) << fault;
    EXPECT_TRUE(says(worn.view->trouble(), word)) << fault << ": " << worn.view->trouble();
    EXPECT_FALSE(worn.view->wait(true)) << fault;
    EXPECT_NO_THROW(worn.view->pulse(0.1, 1)) << fault;
    expectClean(worn.over(), fault);
  }
}

TEST(HeadsetFaults, WhatPassesPasses) {
  const auto run = [](const std::string& fault) {
    Worn worn("eyes=64x64,64x64;fault=" + fault);
    const int shown = worn.show(30);
    EXPECT_EQ(worn.view->trouble(), "") << fault;
    const test::XrReport report = worn.over();
    expectClean(report, fault);
    return std::pair(shown, calls(report, "layers"));
  };
  EXPECT_EQ(run("none@1"), std::pair(30, 30));
  EXPECT_EQ(run("nobody_looks@11"), std::pair(30, 20));
  EXPECT_EQ(run("slow_picture@10"), std::pair(30, 30));
  EXPECT_EQ(run("not_focused@10"), std::pair(30, 30));
  EXPECT_EQ(run("never_worn"), std::pair(0, 0));
  const auto [shown, layers] = run("taken_off@10");  // and put on again
  EXPECT_GE(shown, 28);
  EXPECT_GE(layers, 28);
  EXPECT_GE(run("taken_off@3;rate=6").first,
            5);  // so slow that a frame is still waited for when it ends
}

}  // namespace
}  // namespace palpa::headset
