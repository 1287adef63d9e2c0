#pragma once

#include <string>

#include "apps/task_pulse/pulse_task.h"
#include "apps/trial/trial_scene.h"

namespace palpa::task_pulse {

/// What a pulse task is shown with.
struct PulseSceneSetup {
  trial::TrialScene::Stage stage;
  Pose X_AP = Pose::Identity();  ///< the drawn block, origin in the middle of its top, z up
};

/// What is seen of a pulse: the silicone, the tool, the place that was marked, what is to be done
/// now. Nothing that beats.
class PulseScene final : public trial::TrialScene {
 public:
  PulseScene(const PulseSceneSetup& setup, runtime::Bus& bus, PulseChannels& channels);

 private:
  const trial::TrialStatus& readStatus(std::int64_t now_ns) override;
  void compose(scene::SceneState& state, const runtime::ToolState& tool,
               const std::string& trouble) override;
  void addTo(runtime::Displayed& displayed, const runtime::ToolState& tool) override;
  scene::Hud words(const runtime::ToolState& tool, const std::string& trouble) const;

  PulseSceneSetup setup_;
  PulseChannels& channels_;
  PulseStatus status_;
};

/// What the screen asks: "Find the radial pulse, mark it with the button, then [D]", "Count: 12 s
/// left", "How many beats? 7_", "The rhythm? 1 regular, 2 regular with premature beats, 3
/// irregular".
std::string taskText(const PulseStatus& status);

}  // namespace palpa::task_pulse
