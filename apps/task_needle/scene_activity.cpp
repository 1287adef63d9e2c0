#include "apps/task_needle/scene_activity.h"

#include "apps/task_needle/hud_text.h"

namespace palpa::task_needle {
namespace {

constexpr double kBoneFelt = 0.1;  // N
constexpr double kBonePulse = 0.08, kPuncturePulse = 0.03,
                 kPunctureStrength = 0.6;  // s; [chosen] to be told apart
constexpr double kTrailStep = 0.0005;      // m between points of the trail
constexpr std::size_t kTrailLongest = 4000;

}  // namespace

SceneActivity::SceneActivity(const Setup& setup, runtime::Bus& bus, TaskChannels& channels)
    : TrialScene(setup.stage, bus, channels), setup_(setup), channels_(channels) {
  if (setup.giving_way) skin_.emplace(*setup.giving_way, setup.skin);
}

const trial::TrialStatus& SceneActivity::readStatus(std::int64_t now_ns) {
  if (const TaskStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  return status_;
}

bool SceneActivity::mayWait(const runtime::ToolState& tool) const {
  return tool.phase == haptics::NeedlePhase::outside;
}

/// Tells the hand what a controller can: a layer punctured, bone.
void SceneActivity::pulse(runtime::HeadDisplay& head, const runtime::ToolState& tool) {
  const bool inserted = tool.phase == haptics::NeedlePhase::inserted;
  const bool punctured = inserted && (felt_.phase != haptics::NeedlePhase::inserted ||
                                      (felt_.tissue != tool.tissue && tool.depth > felt_.depth));
  if (tool.bone_force > kBoneFelt && felt_.bone_force <= kBoneFelt)
    head.pulse(kBonePulse, 1);
  else if (punctured)
    head.pulse(kPuncturePulse, kPunctureStrength);
  felt_ = tool;
}

void SceneActivity::compose(scene::SceneState& state, const runtime::ToolState& tool,
                            const std::string& trouble) {
  state.guide = setup_.guide;
  if (skin_) state.skin_push = skin_->follow(tool, X_AD(), now_ns());
  state.plunger = tool.plunger;
  state.blood = status_.blood;
  state.hud = hudText(status_, tool, trouble, mark(), setup_.words);
  showForces(state, tool);
  leaveTrail(state, tool);
}

void SceneActivity::showForces(scene::SceneState& state, const runtime::ToolState& tool) {
  state.forces.clear();
  const Vec3 f_A = X_AD().rotation() * unpack(tool.f_contact_D);
  if (f_A.norm() > 0.05) {
    const Vec3 tip = state.X_AT.translation();
    state.forces.push_back({scene::ForceKind::reaction, tip, f_A});
    const Vec3 felt = X_AD().rotation() * unpack(tool.f_command_D);
    if (felt.norm() > 0.05)
      state.forces.push_back(
          {scene::ForceKind::device, (X_AD() * unpack(tool.X_DT)) * Vec3(0, 0, -0.11), felt});
  }
}

void SceneActivity::leaveTrail(scene::SceneState& state, const runtime::ToolState& tool) {
  if (status_.trial != trail_trial_) {
    trail_trial_ = status_.trial;
    state.trail_A.clear();
  }
  const Vec3 tip = state.X_AT.translation();
  if (status_.state == trial::TrialState::running && tool.phase != haptics::NeedlePhase::outside &&
      state.trail_A.size() < kTrailLongest &&
      (state.trail_A.empty() || (tip - state.trail_A.back()).norm() > kTrailStep))
    state.trail_A.push_back(tip);
}

void SceneActivity::tell(runtime::Displayed& displayed, const runtime::ToolState& tool) {
  displayed.blood_flows = status_.blood_flows;
  displayed.injury = displayed.running && injury(tool);
}

}  // namespace palpa::task_needle
