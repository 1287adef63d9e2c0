#include "apps/task_palpation/palpation_scene.h"

#include <cstdio>

namespace palpa::task_palpation {

std::vector<scene::ForceArrow> shownForces(const runtime::ToolState& tool, const Mat3& R_AD,
                                           const Pose& X_AT, bool apart) {
  constexpr double kShown_N = 0.05;
  const Vec3 f_real_A = R_AD * unpack(tool.f_sensed_D),
             f_device_A = R_AD * unpack(tool.f_command_D), at_handle_T(0, 0, -0.11),
             beside_T(0, 0, -0.06);
  std::vector<scene::ForceArrow> all;
  const auto show = [&](scene::ForceKind kind, const Vec3& p_A, const Vec3& f_A) {
    if (f_A.norm() > kShown_N) all.push_back({kind, p_A, f_A});
  };
  show(scene::ForceKind::reaction, X_AT.translation(),
       apart ? f_real_A : Vec3(f_real_A + f_device_A));
  if (!apart) return all;
  show(scene::ForceKind::device, X_AT * at_handle_T, f_device_A);
  show(scene::ForceKind::felt, X_AT * beside_T, f_real_A + f_device_A);
  return all;
}

namespace {

constexpr const char* kPressures[] = {"", "light", "medium", "deep"};

template <class... Numbers>
std::string lineOf(const char* pattern, Numbers... numbers) {
  char text[96];
  std::snprintf(text, sizeof text, pattern, numbers...);
  return text;
}

}  // namespace

scene::SurfaceMap shownMap(const station::MappedObject& object, const Pose& X_AP) {
  constexpr double kUnsureSd = 0.05, kPerMm = 1e-3;
  scene::SurfaceMap map;
  const Eigen::Vector2d step = object.step();
  map.X_AG = X_AP;
  map.low_x = object.low.x();
  map.low_y = object.low.y();
  map.step_x = step.x();
  map.step_y = step.y();
  map.columns = object.columns;
  map.rows = object.rows;
  for (std::size_t i = 0; i < object.stiffness.size(); ++i) {
    map.values.push_back(static_cast<float>(kPerMm * object.stiffness[i]));
    map.unsure.push_back(object.stiffness_sd[i] > kUnsureSd);
  }
  map.title = lineOf("Stiffness %.0f mm deep", 1e3 * object.depth);
  map.unit = "N/mm";
  return map;
}

PalpationScene::PalpationScene(const PalpationSceneSetup& setup, runtime::Bus& bus,
                               PalpationChannels& channels)
    : TrialScene(setup.stage, bus, channels), setup_(setup), channels_(channels), bus_(bus) {}

const trial::TrialStatus& PalpationScene::readStatus(std::int64_t now_ns) {
  if (const PalpationStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  if (const runtime::ToolState* tool = bus_.second_to_scene.read(now_ns)) second_ = *tool;
  return status_;
}

void PalpationScene::compose(scene::SceneState& state, const runtime::ToolState& tool,
                             const std::string& trouble) {
  state.tool = scene::Tool::probe;
  state.hud = words(tool, trouble);
  showFelt(state);
  state.surface_map = setup_.map ? &*setup_.map : nullptr;
  const bool apart = !status_.lumps.empty();
  state.forces = shownForces(tool, X_AD().rotation(), state.X_AT, apart);
  if (!setup_.X_AD2) return;
  state.second_X_AT = *setup_.X_AD2 * unpack(second_.X_DT);
  for (const scene::ForceArrow& arrow :
       shownForces(second_, setup_.X_AD2->rotation(), *state.second_X_AT, apart))
    state.forces.push_back(arrow);
}

void PalpationScene::addTo(runtime::Displayed& displayed, const runtime::ToolState&) {
  if (setup_.X_AD2) displayed.second_X_AT = *setup_.X_AD2 * unpack(second_.X_DT);
}

/// The area is outlined from the start: it is known what is to be searched.
void PalpationScene::showFelt(scene::SceneState& state) const {
  scene::CoverageGrid grid;
  grid.X_AG = setup_.X_AP;
  grid.columns = status_.columns;
  grid.rows = status_.rows;
  if (grid.columns > 0 && grid.rows > 0) {
    grid.cell_x = 2 * setup_.area.half_x / grid.columns;
    grid.cell_y = 2 * setup_.area.half_y / grid.rows;
    grid.top = setup_.area.top;
    grid.outline = setup_.area.outline;
    grid.levels = status_.levels;
    grid.levels.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                       0);
    state.coverage = grid;
  }
  state.lumps.clear();
  for (const SeenLump& lump : status_.lumps)
    state.lumps.push_back({setup_.X_AP * lump.p_P, lump.radius, lump.found, lump.normal});
  state.marks_A.clear();
  for (const Vec3& p_P : status_.marks_P)
    state.marks_A.push_back(setup_.X_AP * onTop(setup_.area, p_P));
  state.lead_A = status_.lead_P
                     ? std::optional<Vec3>(setup_.X_AP * onTop(setup_.area, *status_.lead_P))
                     : std::nullopt;
}

scene::Hud PalpationScene::words(const runtime::ToolState& tool, const std::string& trouble) const {
  scene::Hud hud;
  trial::tellTrial(status_, "Search for lumps",
                   lineOf("%.1f N ", status_.pressed_N) + kPressures[status_.level], &hud);
  if (status_.active()) {
    hud.note = setup_.force_note;
    if (setup_.estimated)
      hud.note += std::string(hud.note.empty() ? "" : ". ") + "Second finger's force: estimated";
    if (!status_.marks_P.empty())
      hud.marked = lineOf("%d", static_cast<int>(status_.marks_P.size()));
  }
  trial::noticeOf(status_, setup_.X_AD2 ? trial::worse(tool.safety, second_.safety) : tool.safety,
                  "", trouble, &hud);
  hud.mark = mark();
  return hud;
}

}  // namespace palpa::task_palpation
