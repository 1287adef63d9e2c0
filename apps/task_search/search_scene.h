#pragma once

#include "apps/task_search/search_task.h"
#include "apps/trial/trial_scene.h"

namespace palpa::task_search {

/// What a search is shown with.
struct SearchSceneSetup {
  trial::TrialScene::Stage stage;
  Pose X_WF = Pose::Identity();  ///< the floor in the hand, and on the screen
  Pose X_AF = Pose::Identity();
  double side = 0.0144;       ///< m, of the floor in the hand
  double magnification = 10;  ///< of what is shown
};

/// What is seen of a search: the floor's outline and the probe, both magnified; nothing of what is
/// to be felt.
class SearchScene final : public trial::TrialScene {
 public:
  SearchScene(const SearchSceneSetup& setup, runtime::Bus& bus, SearchChannels& channels);

 private:
  const trial::TrialStatus& readStatus(std::int64_t now_ns) override;
  void compose(scene::SceneState& state, const runtime::ToolState& tool,
               const std::string& trouble) override;
  scene::Hud words(const runtime::ToolState& tool, const std::string& trouble) const;

  SearchSceneSetup setup_;
  SearchChannels& channels_;
  SearchStatus status_;
};

/// A point of the hand's floor as it is shown, in A; both frames meet in the floor's middle. Under
/// a floor that gives way it is shown on the floor: magnified, what is pressed in would be far
/// below.
Vec3 shownPoint(const Pose& X_AF, double magnification, const Vec3& p_F);

}  // namespace palpa::task_search
