#include "apps/task_needle/needle_scene.h"

#include <gtest/gtest.h>

namespace palpa::task_needle {
namespace {

using haptics::SafetyCause;

scene::Hud shown(SafetyCause cause, const std::string& device = "") {
  TaskStatus status;
  status.state = trial::TrialState::running;
  status.trial = status.trials = 1;
  status.device = device;
  runtime::ToolState tool;
  tool.safety = cause;
  return hudText(status, tool, "", "");
}

// Who has drawn blood has ten seconds: whatever else happens then, the question is on the screen.
TEST(HudText, TheQuestionIsHiddenByNothingButAnEmergencyStop) {
  TaskStatus status;
  status.state = trial::TrialState::running;
  status.trial = status.trials = 1;
  status.asked = true;
  status.answer_within_s = 6.3;
  status.notice = "Force was off for a moment";
  runtime::ToolState tool;
  tool.tissue = Tissue::lung;
  const scene::Hud hud = hudText(status, tool, "The camera is gone", "");
  EXPECT_EQ(hud.notice, "What did you draw? 1: vein, 2: artery, 3: neither (7 s left)");
  EXPECT_FALSE(hud.alarm);
  status.emergency_stop = true;
  status.notice = "EMERGENCY STOP";
  EXPECT_EQ(hudText(status, tool, "", "").notice, "EMERGENCY STOP");
}

TEST(HudText, SaysWhyTheForceIsGone) {
  for (int i = 0; i < haptics::kSafetyCauseCount; ++i) {
    const auto cause = static_cast<SafetyCause>(i);
    const scene::Hud hud = shown(cause);
    switch (cause) {
      case SafetyCause::none:
      case SafetyCause::clamp:
      case SafetyCause::slew:
      case SafetyCause::not_ready:       // between trials: the notice says what to do
      case SafetyCause::emergency_stop:  // the task's own notice
        EXPECT_EQ(hud.notice, "") << haptics::name(cause);
        break;
      case SafetyCause::deadman:
      case SafetyCause::duty:
        EXPECT_NE(hud.notice, "");
        EXPECT_FALSE(hud.alarm);
        break;
      default:
        EXPECT_EQ(hud.notice.rfind("Force is off: ", 0), 0u) << haptics::name(cause);
        EXPECT_TRUE(hud.alarm) << haptics::name(cause);
    }
  }
}

TEST(HudText, ATripOfOneTickIsShownLongEnoughToBeRead) {
  TaskStatus status;
  status.state = trial::TrialState::running;
  status.trip = SafetyCause::watchdog;
  const scene::Hud hud = hudText(status, {}, "", "");
  EXPECT_NE(hud.notice.find("Force was off for a moment: the computer could not keep up"),
            std::string::npos);
  EXPECT_TRUE(hud.alarm);
}

TEST(HudText, SaysWhatIsWrongWithTheCameraWhereNothingWorseIs) {
  EXPECT_EQ(hudText({}, {}, "the camera is gone", "").notice, "The camera is gone");
  TaskStatus status;
  status.state = trial::TrialState::running;
  runtime::ToolState tool;
  tool.safety = SafetyCause::silent_device;
  EXPECT_EQ(hudText(status, tool, "the camera is gone", "").notice.rfind("Force is off", 0), 0u);
}

TEST(HudText, WhatTheDriverSaysComesFirst) {
  const scene::Hud hud =
      shown(SafetyCause::not_ready, "Pull the grip fully out, then push it fully in.");
  EXPECT_EQ(hud.notice, "Force is off: Pull the grip fully out, then push it fully in.");
  EXPECT_TRUE(hud.alarm);
}

TEST(HudText, CallsThingsByTheTasksWords) {
  TaskStatus status;
  status.state = trial::TrialState::running;
  status.step = "seated";
  runtime::ToolState tool;
  tool.phase = haptics::NeedlePhase::inserted;
  tool.tissue = Tissue::fat;
  tool.depth = 0.0093;
  EXPECT_EQ(hudText(status, tool, "", "").depth, "9 mm inserted, in fat");
  tool.tissue = Tissue::connective;
  EXPECT_EQ(hudText(status, tool, "", "").depth, "9 mm inserted, in connective tissue");
  tool.tissue = Tissue::fat;
  TaskWords words;
  words.tissue[static_cast<std::size_t>(Tissue::fat)] = "cancellous bone";
  words.organ[static_cast<std::size_t>(Organ::skin)] = "bone";
  const scene::Hud hud = hudText(status, tool, "", "", words);
  EXPECT_EQ(hud.depth, "9 mm inserted, in cancellous bone");
  tool.tissue = Tissue::bone;
  EXPECT_EQ(hudText(status, tool, "", "").depth, "9 mm inserted, at bone");
  tool.phase = haptics::NeedlePhase::outside;
  EXPECT_EQ(hudText(status, tool, "", "", words).depth, "outside the bone");
  EXPECT_EQ(hud.phase, "seated");
}

}  // namespace
}  // namespace palpa::task_needle
