#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/task_comparison/comparison_task.h"
#include "apps/trial/trial_scene.h"

namespace palpa::task_comparison {

/// What a comparison is shown with.
struct ComparisonSceneSetup {
  trial::TrialScene::Stage stage;
  std::optional<Pose> X_WD2;     ///< the second device's base, where something is held by two
  Vec3 middle_A = Vec3::Zero();  ///< of the object at rest, where something is held
  Vec3 up_A = Vec3(0, -1, 0);    ///< unit, out of the surface that is stroked
  bool apart = false;            ///< what the devices add is shown apart: a replay
};

/// What is seen of a comparison: the object, moving with the fingers that hold it, or lying under
/// the tool that strokes over it; each tool, and what is felt there.
class ComparisonScene final : public trial::TrialScene {
 public:
  ComparisonScene(const ComparisonSceneSetup& setup, runtime::Bus& bus,
                  ComparisonChannels& channels);

 private:
  const trial::TrialStatus& readStatus(std::int64_t now_ns) override;
  void compose(scene::SceneState& state, const runtime::ToolState& tool,
               const std::string& trouble) override;
  void addTo(runtime::Displayed& displayed, const runtime::ToolState& tool) override;
  scene::Hud words(const runtime::ToolState& tool, const std::string& trouble) const;
  void showSecond(scene::SceneState& state, const runtime::ToolState& tool) const;

  ComparisonSceneSetup setup_;
  ComparisonChannels& channels_;
  runtime::Bus& bus_;
  std::optional<Pose> X_AD2_;
  ComparisonStatus status_;
  runtime::ToolState second_;
};

/// A tool as it is drawn.
struct ShownTool {
  runtime::ToolState tool;
  Pose X_AD = Pose::Identity(), X_AT = Pose::Identity();
};
/// The arrows at both tools, N, in A, as in Jeon, Choi and Harders (2015), their figures 10.6 and
/// 10.7: squeezing and weight at each tip, as they are felt, the first tool's by (10.12) to
/// (10.14):
///     F = (f_1 - f_2) . l / 2,   u_1 = l = -u_2,   reaction F u_*,   weight f_* - F u_*
/// `apart`: these of the real thing alone, what the devices add at the handles, and beside it the
/// sum that is felt. Weaker ones than 0.05 N are not shown.
std::vector<scene::ForceArrow> squeezeForces(const std::array<ShownTool, 2>& tools, bool apart);

/// The arrows at a stroking tool in the same way: what presses back along the surface's normal,
/// and what rubs across it, in the weight's colour:
///     reaction (f . up) up,   friction f - (f . up) up
std::vector<scene::ForceArrow> strokeForces(const ShownTool& tool, const Vec3& up_A, bool apart);

/// Where the object is shown, as moved from where it rests: between the tips that hold it.
Pose heldPlace(const Vec3& first_A, const Vec3& second_A, const Vec3& middle_A, bool held);

/// What the screen asks, and which thing is felt: "Which one is rougher? The second", "From the
/// smoothest to the roughest: surface 2 of 4; said so far 3, 1".
std::string questionText(const ComparisonStatus& status);

}  // namespace palpa::task_comparison
