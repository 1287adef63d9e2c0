#include "apps/task_search/search_scene.h"

#include <algorithm>
#include <cstdio>

namespace palpa::task_search {

Vec3 shownPoint(const Pose& X_AF, double magnification, const Vec3& p_F) {
  return X_AF * Vec3(magnification * p_F.x(), magnification * p_F.y(),
                     magnification * std::max(p_F.z(), 0.0));
}

SearchScene::SearchScene(const SearchSceneSetup& setup, runtime::Bus& bus, SearchChannels& channels)
    : TrialScene(setup.stage, bus, channels), setup_(setup), channels_(channels) {}

const trial::TrialStatus& SearchScene::readStatus(std::int64_t now_ns) {
  if (const SearchStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  return status_;
}

void SearchScene::compose(scene::SceneState& state, const runtime::ToolState& tool,
                          const std::string& trouble) {
  const Vec3 p_F = setup_.X_AF.inverse() * state.X_AT.translation();
  state.X_AT.translation() = shownPoint(setup_.X_AF, setup_.magnification, p_F);
  state.tool = scene::Tool::probe;
  state.skin = scene::SkinStyle::translucent;
  state.forces.clear();
  scene::CoverageGrid outline;
  outline.X_AG = setup_.X_AF;
  outline.columns = outline.rows = 1;
  outline.cell_x = outline.cell_y = setup_.magnification * setup_.side;
  outline.levels = {0};
  state.coverage = outline;
  state.hud = words(tool, trouble);
}

scene::Hud SearchScene::words(const runtime::ToolState& tool, const std::string& trouble) const {
  scene::Hud hud;
  hud.phase = trial::numberOf(status_, "Episode");
  if (status_.active()) {
    hud.phase += status_.held ? "The handle is held: it is let go in a moment"
                              : "Find the rough one; stay in its middle";
    const int seconds = static_cast<int>(status_.elapsed_s);
    char text[16];
    std::snprintf(text, sizeof text, "%d:%02d", seconds / 60, seconds % 60);
    hud.time = text;
    if (!status_.force_feedback) hud.note = "force feedback off";
  }
  trial::noticeOf(status_, tool.safety, "", trouble, &hud);
  hud.mark = mark();
  return hud;
}

}  // namespace palpa::task_search
