#pragma once

#include <cstdint>
#include <optional>

#include "anatomy/query/skin_dimple.h"
#include "anatomy/query/surface_query.h"
#include "apps/runtime/bus.h"
#include "apps/task_needle/needle_task.h"
#include "apps/task_needle/task_file.h"
#include "apps/trial/trial_scene.h"
#include "scene/scene_state.h"

namespace palpa::task_needle {

/// The needle is in the lung or an artery, or in their walls.
bool injury(const runtime::ToolState& tool);

/// The HUD's lines in clinical words. The step that a trial has come to leads, and is there with
/// guidance; an injury is told with words of contact. `camera`: what is wrong with the camera
/// (apps/runtime/camera_trouble.h); empty: nothing.
scene::Hud hudText(const TaskStatus& status, const runtime::ToolState& tool,
                   const std::string& camera, const std::string& mark, const TaskWords& words = {},
                   const presentation::Presentation& shown = {});

/// How the needle moves the skin that is shown.
///   before puncture   the skin is where the tip is: pushed from the tip's nearest point on it,
///                     straight to the tip
///   inserted          at the entry: what the shaft's friction drags, axial force / stiffness, at
///                     most 3 mm; inward while the needle goes in, outward (a tent) while it is
///                     drawn out
///   after puncture,   what is left goes exponentially to that, tau = 0.15 s
///   after withdrawal
/// Only what is drawn; no force and no score knows of it.
class SkinFollower {
 public:
  SkinFollower(const anatomy::SurfaceQuery& query, int skin) : query_(query), skin_(skin) {}

  std::optional<anatomy::SkinPush> follow(const runtime::ToolState& tool, const Pose& X_AD,
                                          std::int64_t now_ns);

 private:
  anatomy::SkinPush pushed(const Pose& X_AT) const;
  double dragged(const runtime::ToolState& tool, const Vec3& axis_A, const Pose& X_AD) const;

  const anatomy::SurfaceQuery& query_;
  int skin_;
  std::optional<anatomy::SkinPush> push_;
  std::int64_t last_ns_ = 0;
};

/// What a needle's trials are shown with.
struct NeedleSceneSetup {
  trial::TrialScene::Stage stage;
  /// The skin is shown to give way (surface `skin` of this patient); null: it is not.
  const anatomy::SurfaceQuery* giving_way = nullptr;
  int skin = 0;
  std::optional<scene::GuideLine> guide;
  TaskWords words;
};

/// What is seen of a needle's trial: the skin that gives way, the syringe, forces, the tip's way.
class NeedleScene final : public trial::TrialScene {
 public:
  NeedleScene(const NeedleSceneSetup& setup, runtime::Bus& bus, TaskChannels& channels);

 private:
  const trial::TrialStatus& readStatus(std::int64_t now_ns) override;
  void compose(scene::SceneState& state, const runtime::ToolState& tool,
               const std::string& trouble) override;
  void addTo(runtime::Displayed& displayed, const runtime::ToolState& tool) override;
  void pulse(scene::HeadDisplay& head, const runtime::ToolState& tool) override;
  bool mayWait(const runtime::ToolState& tool) const override;
  void showForces(scene::SceneState& state, const runtime::ToolState& tool);
  void leaveTrail(scene::SceneState& state, const runtime::ToolState& tool);

  NeedleSceneSetup setup_;
  TaskChannels& channels_;
  TaskStatus status_;
  std::optional<SkinFollower> skin_;
  runtime::ToolState felt_;  ///< what the hand in a headset was last told
  int trail_trial_ = 0;
};

}  // namespace palpa::task_needle
