#include "apps/task_comparison/comparison_scene.h"

#include <algorithm>
#include <cstdio>

namespace palpa::task_comparison {
namespace {

constexpr double kShown_N = 0.05;

/// What is drawn at one tool: two parts of a force at its tip; apart, what the device adds at the
/// handle, and beside it the sum.
class ToolArrows {
 public:
  ToolArrows(const ShownTool& tool, bool apart)
      : tool_(tool),
        apart_(apart),
        device_(tool.X_AD.rotation() * unpack(tool.tool.f_command_D)),
        shown_(tool.X_AD.rotation() * unpack(tool.tool.f_sensed_D) +
               (apart ? Vec3::Zero() : device_)) {}

  const Vec3& shown() const { return shown_; }

  /// `rest`: what the force beside the reaction is.
  void add(const Vec3& reaction, scene::ForceKind rest, std::vector<scene::ForceArrow>* all) const {
    const Vec3 at_handle_T(0, 0, -0.11), beside_T(0, 0, -0.06);
    const auto show = [all](scene::ForceKind kind, const Vec3& p_A, const Vec3& f_A) {
      if (f_A.norm() > kShown_N) all->push_back({kind, p_A, f_A});
    };
    const Vec3 tip = tool_.X_AT.translation();
    show(scene::ForceKind::reaction, tip, reaction);
    show(rest, tip, shown_ - reaction);
    if (!apart_) return;
    show(scene::ForceKind::device, tool_.X_AT * at_handle_T, device_);
    show(scene::ForceKind::felt, tool_.X_AT * beside_T, shown_ + device_);
  }

 private:
  const ShownTool& tool_;
  bool apart_;
  Vec3 device_, shown_;
};

}  // namespace

Pose heldPlace(const Vec3& first_A, const Vec3& second_A, const Vec3& middle_A, bool held) {
  return held ? makePose(Mat3::Identity(), 0.5 * (first_A + second_A) - middle_A)
              : Pose::Identity();
}

std::vector<scene::ForceArrow> squeezeForces(const std::array<ShownTool, 2>& tools, bool apart) {
  const Vec3 between = tools[0].X_AT.translation() - tools[1].X_AT.translation();
  if (!(between.norm() > 0)) return {};
  const Vec3 l = between.normalized();
  const ToolArrows first(tools[0], apart), second(tools[1], apart);
  const double F = std::max(0.5 * (first.shown() - second.shown()).dot(l), 0.0);
  std::vector<scene::ForceArrow> all;
  first.add(F * l, scene::ForceKind::weight, &all);
  second.add(-F * l, scene::ForceKind::weight, &all);
  return all;
}

std::vector<scene::ForceArrow> strokeForces(const ShownTool& tool, const Vec3& up_A, bool apart) {
  const ToolArrows arrows(tool, apart);
  std::vector<scene::ForceArrow> all;
  arrows.add(arrows.shown().dot(up_A) * up_A, scene::ForceKind::friction, &all);
  return all;
}

std::string questionText(const ComparisonStatus& status) {
  if (status.things == 2)
    return std::string("Which one is ") + moreOf(status.property) + "? " +
           (status.thing == 0 ? "The first" : "The second");
  const std::string said =
      status.order.empty() ? std::string() : "; said so far " + assess::orderText(status.order);
  return "From the smoothest to the roughest: surface " + std::to_string(status.thing + 1) +
         " of " + std::to_string(status.things) + said;
}

ComparisonScene::ComparisonScene(const ComparisonSceneSetup& setup, runtime::Bus& bus,
                                 ComparisonChannels& channels)
    : TrialScene(setup.stage, bus, channels), setup_(setup), channels_(channels), bus_(bus) {
  if (setup.X_WD2) X_AD2_ = (setup.X_WD2->inverse() * setup.stage.X_WA).inverse();
}

const trial::TrialStatus& ComparisonScene::readStatus(std::int64_t now_ns) {
  if (const ComparisonStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  if (const runtime::ToolState* tool = bus_.second_to_scene.read(now_ns)) second_ = *tool;
  return status_;
}

void ComparisonScene::compose(scene::SceneState& state, const runtime::ToolState& tool,
                              const std::string& trouble) {
  state.tool = scene::Tool::probe;
  state.skin = scene::SkinStyle::solid;
  state.hud = words(tool, trouble);
  if (X_AD2_) return showSecond(state, tool);
  state.forces = strokeForces({tool, X_AD(), state.X_AT}, setup_.up_A, setup_.apart);
}

void ComparisonScene::showSecond(scene::SceneState& state, const runtime::ToolState& tool) const {
  state.second_X_AT = *X_AD2_ * unpack(second_.X_DT);
  state.X_AB = heldPlace(state.X_AT.translation(), state.second_X_AT->translation(),
                         setup_.middle_A, status_.touching);
  state.forces = squeezeForces(
      {{{tool, X_AD(), state.X_AT}, {second_, *X_AD2_, *state.second_X_AT}}}, setup_.apart);
}

void ComparisonScene::addTo(runtime::Displayed& displayed, const runtime::ToolState&) {
  using Question = runtime::Displayed::Question;
  if (X_AD2_) displayed.second_X_AT = *X_AD2_ * unpack(second_.X_DT);
  displayed.things = status_.things;
  displayed.question = status_.things > 2                                        ? Question::order
                       : status_.property == assess::ComparedProperty::stiffness ? Question::harder
                       : status_.property == assess::ComparedProperty::weight    ? Question::heavier
                                                                              : Question::rougher;
}

scene::Hud ComparisonScene::words(const runtime::ToolState& tool,
                                  const std::string& trouble) const {
  scene::Hud hud;
  char force[32];
  std::snprintf(force, sizeof force, "%.1f N", status_.force_N);
  trial::tellTrial(status_, questionText(status_), force, &hud);
  const haptics::SafetyCause safety =
      X_AD2_ ? trial::worse(tool.safety, second_.safety) : tool.safety;
  trial::noticeOf(status_, safety, "", trouble, &hud);
  hud.mark = mark();
  return hud;
}

}  // namespace palpa::task_comparison
