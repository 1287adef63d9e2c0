#include "apps/task_squeeze/squeeze_scene.h"

#include <cstdio>

namespace palpa::task_squeeze {

Pose heldPlace(const Vec3& first_A, const Vec3& second_A, const Vec3& middle_A, bool held) {
  return held ? makePose(Mat3::Identity(), 0.5 * (first_A + second_A) - middle_A)
              : Pose::Identity();
}

SqueezeScene::SqueezeScene(const SqueezeSceneSetup& setup, runtime::Bus& bus,
                           SqueezeChannels& channels)
    : TrialScene(setup.stage, bus, channels),
      setup_(setup),
      channels_(channels),
      bus_(bus),
      X_AD2_((setup.X_WD2.inverse() * setup.stage.X_WA).inverse()) {}

const trial::TrialStatus& SqueezeScene::readStatus(std::int64_t now_ns) {
  if (const SqueezeStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  if (const runtime::ToolState* tool = bus_.second_to_scene.read(now_ns)) second_ = *tool;
  return status_;
}

void SqueezeScene::compose(scene::SceneState& state, const runtime::ToolState& tool,
                           const std::string& trouble) {
  constexpr double kShown_N = 0.05;
  state.tool = scene::Tool::probe;
  state.skin = scene::SkinStyle::solid;
  state.second_X_AT = X_AD2_ * unpack(second_.X_DT);
  state.X_AB = heldPlace(state.X_AT.translation(), state.second_X_AT->translation(),
                         setup_.middle_A, status_.held);
  state.hud = words(tool, trouble);
  state.forces.clear();
  const auto show = [&](const runtime::ToolState& of, const Pose& X_AD, const Pose& X_AT) {
    const Vec3 felt_A = X_AD.rotation() * (unpack(of.f_sensed_D) + unpack(of.f_command_D));
    if (felt_A.norm() > kShown_N)
      state.forces.push_back({scene::ForceKind::reaction, X_AT.translation(), felt_A});
  };
  show(tool, X_AD(), state.X_AT);
  show(second_, X_AD2_, *state.second_X_AT);
}

void SqueezeScene::addTo(runtime::Displayed& displayed, const runtime::ToolState&) {
  displayed.second_X_AT = X_AD2_ * unpack(second_.X_DT);
  displayed.question = status_.property == assess::SqueezedProperty::stiffness
                           ? runtime::Displayed::Question::harder
                           : runtime::Displayed::Question::heavier;
}

scene::Hud SqueezeScene::words(const runtime::ToolState& tool, const std::string& trouble) const {
  scene::Hud hud;
  char text[96];
  if (status_.trials > 1 && status_.trial > 0) {
    std::snprintf(text, sizeof text, "Trial %d of %d  ", status_.trial, status_.trials);
    hud.phase = text;
  }
  if (status_.active()) {
    hud.phase += std::string("Which one is ") + moreOf(status_.property) + "? " +
                 (status_.thing == 0 ? "The first" : "The second");
    std::snprintf(text, sizeof text, "%.1f N%s", status_.squeezed_N,
                  status_.force_feedback ? "" : " (force feedback off)");
    hud.force = text;
    const int seconds = static_cast<int>(status_.elapsed_s);
    std::snprintf(text, sizeof text, "%d:%02d", seconds / 60, seconds % 60);
    hud.time = text;
  }
  const haptics::SafetyCause safety =
      second_.safety != haptics::SafetyCause::none ? second_.safety : tool.safety;
  trial::noticeOf(status_, safety, "", trouble, &hud);
  hud.mark = mark();
  return hud;
}

}  // namespace palpa::task_squeeze
