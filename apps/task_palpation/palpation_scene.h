#pragma once

#include "apps/task_palpation/palpation_task.h"
#include "apps/trial/trial_scene.h"

namespace palpa::task_palpation {

/// What is seen of a palpation: the area and how firmly it was felt, marks, lumps where they may be
/// seen, the force.
class PalpationScene final : public trial::TrialScene {
 public:
  struct Setup {
    Stage stage;
    Pose X_AP = Pose::Identity();
    assess::SearchArea area;
    double tip_radius = 0.008;  ///< m
    std::string force_note;  ///< "scaled force: ..."; empty: the device gives what a patient would
  };
  PalpationScene(const Setup& setup, runtime::Bus& bus, PalpationChannels& channels);

 private:
  const trial::TrialStatus& readStatus(std::int64_t now_ns) override;
  void compose(scene::SceneState& state, const runtime::ToolState& tool,
               const std::string& trouble) override;
  void showFelt(scene::SceneState& state) const;
  scene::Hud words(const runtime::ToolState& tool, const std::string& trouble) const;

  Setup setup_;
  PalpationChannels& channels_;
  PalpationStatus status_;
};

}  // namespace palpa::task_palpation
