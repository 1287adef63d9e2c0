#include "apps/task_comparison/comparison_scene.h"

#include <algorithm>
#include <cstdio>

namespace palpa::task_comparison {

Pose heldPlace(const Vec3& first_A, const Vec3& second_A, const Vec3& middle_A, bool held) {
  return held ? makePose(Mat3::Identity(), 0.5 * (first_A + second_A) - middle_A)
              : Pose::Identity();
}

std::vector<scene::ForceArrow> squeezeForces(const std::array<ShownTool, 2>& tools, bool apart) {
  constexpr double kShown_N = 0.05;
  const Vec3 at_handle_T(0, 0, -0.11), beside_T(0, 0, -0.06);
  const Vec3 between = tools[0].X_AT.translation() - tools[1].X_AT.translation();
  if (!(between.norm() > 0)) return {};
  const Vec3 l = between.normalized();
  std::array<Vec3, 2> device, shown;
  for (std::size_t t = 0; t < 2; ++t) {
    const Mat3 R_AD = tools[t].X_AD.rotation();
    device[t] = R_AD * unpack(tools[t].tool.f_command_D);
    shown[t] = R_AD * unpack(tools[t].tool.f_sensed_D) + (apart ? Vec3::Zero() : device[t]);
  }
  std::vector<scene::ForceArrow> all;
  const auto show = [&all](scene::ForceKind kind, const Vec3& p_A, const Vec3& f_A) {
    if (f_A.norm() > kShown_N) all.push_back({kind, p_A, f_A});
  };
  const double F = std::max(0.5 * (shown[0] - shown[1]).dot(l), 0.0);
  for (std::size_t t = 0; t < 2; ++t) {
    const Vec3 squeezing = (t == 0 ? F : -F) * l, tip = tools[t].X_AT.translation();
    show(scene::ForceKind::reaction, tip, squeezing);
    show(scene::ForceKind::weight, tip, shown[t] - squeezing);
    if (!apart) continue;
    show(scene::ForceKind::device, tools[t].X_AT * at_handle_T, device[t]);
    show(scene::ForceKind::felt, tools[t].X_AT * beside_T, shown[t] + device[t]);
  }
  return all;
}

ComparisonScene::ComparisonScene(const ComparisonSceneSetup& setup, runtime::Bus& bus,
                           ComparisonChannels& channels)
    : TrialScene(setup.stage, bus, channels),
      setup_(setup),
      channels_(channels),
      bus_(bus),
      X_AD2_((setup.X_WD2.inverse() * setup.stage.X_WA).inverse()) {}

const trial::TrialStatus& ComparisonScene::readStatus(std::int64_t now_ns) {
  if (const ComparisonStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  if (const runtime::ToolState* tool = bus_.second_to_scene.read(now_ns)) second_ = *tool;
  return status_;
}

void ComparisonScene::compose(scene::SceneState& state, const runtime::ToolState& tool,
                           const std::string& trouble) {
  state.tool = scene::Tool::probe;
  state.skin = scene::SkinStyle::solid;
  state.second_X_AT = X_AD2_ * unpack(second_.X_DT);
  state.X_AB = heldPlace(state.X_AT.translation(), state.second_X_AT->translation(),
                         setup_.middle_A, status_.held);
  state.hud = words(tool, trouble);
  state.forces = squeezeForces(
      {{{tool, X_AD(), state.X_AT}, {second_, X_AD2_, *state.second_X_AT}}}, setup_.apart);
}

void ComparisonScene::addTo(runtime::Displayed& displayed, const runtime::ToolState&) {
  displayed.second_X_AT = X_AD2_ * unpack(second_.X_DT);
  displayed.question = status_.property == assess::ComparedProperty::stiffness
                           ? runtime::Displayed::Question::harder
                           : runtime::Displayed::Question::heavier;
}

scene::Hud ComparisonScene::words(const runtime::ToolState& tool, const std::string& trouble) const {
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
  trial::noticeOf(status_, trial::worse(tool.safety, second_.safety), "", trouble, &hud);
  hud.mark = mark();
  return hud;
}

}  // namespace palpa::task_comparison
