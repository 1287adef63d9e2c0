#pragma once

#include <optional>
#include <vector>

#include "apps/runtime/bus.h"
#include "apps/task_palpation/palpation_task.h"
#include "apps/trial/trial_scene.h"
#include "scene/scene_state.h"

namespace palpa::task_palpation {

/// The arrows at a tool that presses, N, in A: what the real thing gives back, at the tip, and what
/// the device adds, at the handle, both as the loop recorded them; between them their sum. Where
/// they may not be told apart only what is felt, their sum: the device does nothing but lumps, and
/// its arrow would give them away. Weaker ones than 0.05 N are not shown.
std::vector<scene::ForceArrow> shownForces(const runtime::ToolState& tool, const Mat3& R_AD,
                                           const Pose& X_AT, bool apart);

/// A learnt map's stiffness as it is drawn; a place is unsure where the 95 % interval is wider than
/// 10 % to either side.
scene::SurfaceMap shownMap(const station::MappedObject& object, const Pose& X_AP);

/// What a palpation is shown with.
struct PalpationSceneSetup {
  trial::TrialScene::Stage stage;
  Pose X_AP = Pose::Identity();
  assess::SearchArea area;
  double tip_radius = 0.008;                  ///< m
  std::string force_note;                     ///< what deep is here; empty: as on a patient
  std::optional<Pose> X_AD2;                  ///< the second device's base, of two
  bool estimated = false;                     ///< what the second presses with is no sensor's
  std::optional<scene::SurfaceMap> map = {};  ///< of the phantom's stiffness
};

/// What is seen of a palpation: the area and how firmly it was felt, marks, lumps where they may be
/// seen, the force.
class PalpationScene final : public trial::TrialScene {
 public:
  PalpationScene(const PalpationSceneSetup& setup, runtime::Bus& bus, PalpationChannels& channels);

 private:
  const trial::TrialStatus& readStatus(std::int64_t now_ns) override;
  void compose(scene::SceneState& state, const runtime::ToolState& tool,
               const std::string& trouble) override;
  void addTo(runtime::Displayed& displayed, const runtime::ToolState& tool) override;
  void showFelt(scene::SceneState& state) const;
  scene::Hud words(const runtime::ToolState& tool, const std::string& trouble) const;

  PalpationSceneSetup setup_;
  PalpationChannels& channels_;
  runtime::Bus& bus_;
  PalpationStatus status_;
  runtime::ToolState second_;  // of two
};

}  // namespace palpa::task_palpation
