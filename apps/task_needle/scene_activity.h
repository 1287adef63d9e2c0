#pragma once

#include "apps/task_needle/needle_task.h"
#include "apps/task_needle/skin_follower.h"
#include "apps/trial/trial_scene.h"

namespace palpa::task_needle {

/// What is seen of a needle's trial: the skin that gives way, the syringe, forces, the tip's way.
class SceneActivity final : public trial::TrialScene {
 public:
  struct Setup {
    Stage stage;
    /// The skin is shown to give way (surface `skin` of this patient); null: it is not.
    const anatomy::SurfaceQuery* giving_way = nullptr;
    int skin = 0;
    std::optional<scene::Guide> guide;
    TaskWords words;
  };
  SceneActivity(const Setup& setup, runtime::Bus& bus, TaskChannels& channels);

 private:
  const trial::TrialStatus& readStatus(std::int64_t now_ns) override;
  void compose(scene::SceneState& state, const runtime::ToolState& tool,
               const std::string& trouble) override;
  void tell(runtime::Displayed& displayed, const runtime::ToolState& tool) override;
  void pulse(runtime::HeadDisplay& head, const runtime::ToolState& tool) override;
  bool mayWait(const runtime::ToolState& tool) const override;
  void showForces(scene::SceneState& state, const runtime::ToolState& tool);
  void leaveTrail(scene::SceneState& state, const runtime::ToolState& tool);

  Setup setup_;
  TaskChannels& channels_;
  TaskStatus status_;
  std::optional<SkinFollower> skin_;
  runtime::ToolState felt_;  ///< what the hand in a headset was last told
  int trail_trial_ = 0;
};

}  // namespace palpa::task_needle
