#include <gtest/gtest.h>

#include "apps/task_needle/needle_scene.h"
#include "tests/support/camera_views.h"

/// What the scene holds to be drawn, in each presentation, of a needle that leans on the clavicle
/// in the lung with blood in the syringe: everything at once.
namespace palpa::task_needle {
namespace {

presentation::Presentation shipped(const std::string& name) {
  return presentation::readPresentation(std::string(PALPA_SOURCE_DIR) + "/assets/presentations/" +
                                        name + ".json");
}

TaskStatus statusOf(training::Role role, bool force_feedback) {
  TaskStatus status;
  status.state = trial::TrialState::running;
  status.trial = status.trials = 1;
  status.role = role;
  status.force_feedback = force_feedback;
  status.step = "Phase 2: advance to the vein";
  status.flows = Tissue::vein_lumen;
  status.blood = 0.4;
  return status;
}

runtime::ToolState toolAt(double depth) {
  runtime::ToolState tool;
  tool.X_DT = pack(Pose(Eigen::Translation3d(0, 0, -depth)));
  tool.phase = haptics::NeedlePhase::inserted;
  tool.tissue = Tissue::lung;
  tool.bone = Organ::clavicle;
  tool.depth = depth;
  tool.plunger = 0.5;
  tool.f_contact_D = {0, 0, 2};
  tool.f_command_D = {0, 0, 1};
  return tool;
}

/// Somebody who wears a headset and feels its controller shake.
class CountingHead final : public scene::HeadDisplay {
 public:
  bool wait(bool) override { return true; }
  void show(const scene::SceneState&) override {}
  void pulse(double, double) override { ++pulses; }
  std::string trouble() const override { return ""; }
  int pulses = 0;
};

/// After some steps of an insertion.
scene::SceneState sceneIn(const presentation::Presentation& shown, bool force_feedback = false,
                          scene::HeadDisplay* head = nullptr) {
  runtime::Bus bus(runtime::TimeMode::virtual_time);
  TaskChannels channels(runtime::TimeMode::virtual_time);
  scene::SceneState seen;
  NeedleSceneSetup setup;
  setup.stage.camera = test::webcam();
  setup.stage.shown = shown;
  setup.stage.head = head;
  setup.stage.watch = [&](const scene::SceneState& state, const trial::TrialStatus&, std::int64_t) {
    seen = state;
  };
  setup.guide = scene::GuideLine{Vec3::Zero(), Vec3(0, 0, -0.03)};
  NeedleScene scene(setup, bus, channels);
  std::int64_t now = 0;
  for (int i = 1; i <= 10; ++i, now += 33'333'333) {
    channels.status_to_scene.publish(statusOf(training::Role::scored, force_feedback), now);
    bus.haptic_to_scene.publish(toolAt(0.002 * i), now);
    scene.step(now);
  }
  return seen;
}

TEST(SceneShown, PracticeShowsWhatThereIs) {
  const scene::SceneState seen = sceneIn(shipped("practice"));
  EXPECT_EQ(seen.skin, scene::SkinStyle::translucent);
  EXPECT_EQ(seen.forces.size(), 2u);
  EXPECT_GT(seen.trail_A.size(), 5u);
  EXPECT_TRUE(seen.guide);
  EXPECT_EQ(seen.hud.force, "2.0 N (force feedback off)");
  EXPECT_EQ(seen.hud.depth, "20 mm inserted, in lung");
  EXPECT_EQ(seen.hud.touched, "LUNG");
  EXPECT_EQ(seen.hud.phase, "Phase 2: advance to the vein");
  EXPECT_EQ(seen.hud.notice, "The needle touches the lung: pull it back");
  EXPECT_TRUE(seen.hud.alarm);
}

class NothingReplacesFeeling : public testing::TestWithParam<const char*> {};

TEST_P(NothingReplacesFeeling, InTheScene) {
  const presentation::Presentation shown = shipped(GetParam());
  EXPECT_TRUE(presentation::unaided(shown));
  const scene::SceneState seen = sceneIn(shown);
  EXPECT_EQ(seen.skin, scene::SkinStyle::solid);
  EXPECT_TRUE(seen.forces.empty());
  EXPECT_TRUE(seen.trail_A.empty());
  EXPECT_FALSE(seen.guide);
  EXPECT_FALSE(seen.skin_push);
  for (const std::string& words :
       {seen.hud.phase, seen.hud.depth, seen.hud.force, seen.hud.touched})
    EXPECT_EQ(words, "");
  EXPECT_FALSE(seen.hud.alarm);
  // There without a simulator:
  EXPECT_EQ(seen.hud.notice, "Blood flows into the syringe");
  EXPECT_EQ(seen.hud.time, "0:00");
  EXPECT_EQ(seen.blood, 0.4);
  EXPECT_EQ(seen.plunger, 0.5);
  EXPECT_TRUE(seen.show_tool);
}

INSTANTIATE_TEST_SUITE_P(Of, NothingReplacesFeeling, testing::Values("assessed", "pilot"),
                         [](const auto& of) { return std::string(of.param); });

TEST(SceneShown, SubstitutionShowsTheForceAndNothingElse) {
  const scene::SceneState seen = sceneIn(shipped("substitution")),
                          pilot = sceneIn(shipped("pilot"));
  EXPECT_EQ(seen.forces.size(), 2u);
  EXPECT_EQ(seen.hud.force, "2.0 N (force feedback off)");
  scene::Hud rest = seen.hud;
  rest.force.clear();
  EXPECT_EQ(rest, pilot.hud);
  EXPECT_EQ(seen.skin, pilot.skin);
  EXPECT_TRUE(seen.trail_A.empty());
}

TEST(SceneShown, WhereNoForceIsFeltPracticeDoesNotTellIt) {
  const scene::SceneState seen = sceneIn(presentation::withoutForces(shipped("practice")));
  EXPECT_TRUE(seen.forces.empty());
  EXPECT_EQ(seen.hud.force + seen.hud.depth + seen.hud.touched, "");
  EXPECT_FALSE(seen.hud.alarm);
  EXPECT_GT(seen.trail_A.size(), 0u);
}

/// A controller that shakes would be a force by another way.
TEST(SceneShown, AControllerTellsNoLayerWhereNoForceIsFelt) {
  CountingHead felt, not_felt;
  sceneIn(shipped("practice"), true, &felt);
  EXPECT_GT(felt.pulses, 0);
  sceneIn(shipped("practice"), false, &not_felt);
  EXPECT_EQ(not_felt.pulses, 0);
}

}  // namespace
}  // namespace palpa::task_needle
