#include "apps/sound/session_sound.h"

#include <gtest/gtest.h>

#include "apps/presentation/presentation.h"
#include "apps/sound/tones.h"
#include "apps/station/assets.h"
#include "apps/task_needle/needle_scene.h"
#include "apps/trial/trial_scene.h"
#include "fake_output.h"

namespace palpa::sound {
namespace {

presentation::Presentation shipped(const std::string& name) {
  return presentation::readPresentation(station::assetFile("presentations") / (name + ".json"));
}

task_needle::TaskStatus inTrial() {
  task_needle::TaskStatus status;
  status.trial = 1;
  status.state = trial::TrialState::running;
  return status;
}

/// What a needle's session shows of it, as TrialScene puts it together.
scene::SceneState shownOf(const task_needle::TaskStatus& status, const runtime::ToolState& tool,
                          const presentation::Presentation& shown) {
  scene::SceneState state;
  state.blood = status.blood;
  state.blood_of = status.holds;
  state.hud = task_needle::hudText(status, tool, "", "", {}, shown);
  trial::keepShown(shown, &state);
  return state;
}

Seen seenOf(Tissue tissue, const presentation::Presentation& shown) {
  runtime::ToolState tool;
  tool.phase = haptics::NeedlePhase::inserted;
  tool.depth = 0.03;
  tool.tissue = tissue;
  task_needle::TaskStatus status = inTrial();
  status.blood = 0.2;
  status.holds = status.flows = tissue;
  return seenIn(shownOf(status, tool, shown), status);
}

TEST(Seen, InPracticeAnArteryIsToldAndAWarningAsOnTheScreen) {
  const Seen artery = seenOf(Tissue::artery_lumen, shipped("practice"));
  EXPECT_TRUE(artery.running);
  EXPECT_TRUE(artery.arterial);
  EXPECT_EQ(artery.urgency, Urgency::medium);
  EXPECT_DOUBLE_EQ(artery.blood, 0.2);
  const Seen vein = seenOf(Tissue::vein_lumen, shipped("practice"));
  EXPECT_FALSE(vein.arterial);
  EXPECT_EQ(vein.urgency, Urgency::none);
  EXPECT_EQ(seenOf(Tissue::lung, shipped("practice")).urgency, Urgency::medium);
}

/// What the trainee is to tell from the blood's colour no sound tells.
TEST(Seen, WhereTheScreenDoesNotNameItTheSoundDoesNotEither) {
  for (const char* name : {"assessed", "pilot"}) {
    const presentation::Presentation shown = shipped(name);
    const Seen vein = seenOf(Tissue::vein_lumen, shown);
    EXPECT_EQ(seenOf(Tissue::artery_lumen, shown), vein) << name;
    EXPECT_FALSE(vein.arterial) << name;
    EXPECT_EQ(seenOf(Tissue::lung, shown).urgency, Urgency::none) << name;
  }
  const Seen hidden =
      seenOf(Tissue::artery_lumen, presentation::withoutForces(shipped("practice")));
  EXPECT_FALSE(hidden.arterial);
  EXPECT_EQ(hidden.urgency, Urgency::none);
}

TEST(Seen, ForceThatIsTakenAwayIsUrgentInEveryPresentation) {
  for (const char* name : {"practice", "assessed"}) {
    const presentation::Presentation shown = shipped(name);
    task_needle::TaskStatus tripped = inTrial(), stopped = inTrial();
    tripped.trip = haptics::SafetyCause::silent_device;
    stopped.emergency_stop = stopped.alarm = true;
    stopped.notice = "EMERGENCY STOP";
    stopped.state = trial::TrialState::paused;
    for (const task_needle::TaskStatus& status : {tripped, stopped})
      EXPECT_EQ(seenIn(shownOf(status, {}, shown), status).urgency, Urgency::high) << name;
  }
}

TEST(Seen, APausedTrialDoesNotRun) {
  task_needle::TaskStatus paused = inTrial();
  paused.state = trial::TrialState::paused;
  EXPECT_FALSE(seenIn(shownOf(paused, {}, shipped("practice")), paused).running);
}

class Session : public testing::Test {
 protected:
  std::shared_ptr<Taken> taken_ = std::make_shared<Taken>();
  runtime::SteadyClock clock_;
  runtime::StopSwitch stop_;
  SessionSound sound_{std::nullopt, stop_, clock_, openFake(taken_)};

  void step() { sound_.step(clock_.now()); }
};

constexpr double kNear = 0.01;  // the fake device takes a block at any time: a cue is not cut there

TEST_F(Session, AStopSoundsThoughNothingIsDrawnAnyMore) {
  step();
  EXPECT_EQ(largestIn(taken_->next(20)), 0);
  stop_.press();
  step();
  EXPECT_NEAR(largestIn(taken_->next(40)), amplitudeOf(voiceOf(Cue::alarm).level_dBFS), kNear);
}

TEST_F(Session, ItsOwnEndIsNoAlarm) {
  stop_.end();
  step();
  EXPECT_EQ(largestIn(taken_->next(40)), 0);
}

TEST_F(Session, WhatTheScreenWarnsOfIsHeard) {
  scene::SceneState shown;
  shown.hud.alarm = true;
  EXPECT_EQ(sound_.see(shown, inTrial(), clock_.now()), "");
  step();
  EXPECT_NEAR(largestIn(taken_->next(40)), amplitudeOf(voiceOf(Cue::warning).level_dBFS), kNear);
}

TEST_F(Session, TheKeyTurnsItOffAndOn) {
  EXPECT_EQ(sound_.handle({"p", "m"}), "");
  EXPECT_EQ(sound_.handle({"s"}), "The sound is off");
  taken_->next(1);  // within 10 ms
  stop_.press();
  step();
  EXPECT_EQ(largestIn(taken_->next(40)), 0);
  EXPECT_EQ(sound_.handle({"s"}), "The sound is on");
  EXPECT_GT(largestIn(taken_->next(40)), 0) << "the burst is still on";
  EXPECT_EQ(sound_.facts(), "played on a fake device; key S was pressed 2 times");
}

TEST(SessionWithoutADevice, SaysSoOnceAndGoesOn) {
  const runtime::SteadyClock clock;
  runtime::StopSwitch stop;
  SessionSound sound(72, stop, clock, []() -> std::unique_ptr<Output> {
    throw std::runtime_error("No sound device: none is here");
  });
  std::string said;
  EXPECT_TRUE(runtime::comesTrue(std::chrono::seconds(10), [&] {
    said = sound.see({}, inTrial(), clock.now());
    return !said.empty();
  }));
  EXPECT_EQ(said, "No sound device: none is here; the session goes on in silence");
  EXPECT_EQ(sound.see({}, inTrial(), clock.now()), "");
  EXPECT_GT(sound.step(clock.now()), 0);
  EXPECT_EQ(sound.facts(), "not heard: No sound device: none is here");
}

}  // namespace
}  // namespace palpa::sound
