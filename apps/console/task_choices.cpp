#include "apps/console/task_choices.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "apps/console/stations.h"
#include "apps/station/assets.h"
#include "apps/station/material_files.h"
#include "apps/station/task_sections.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using training::Engine;

/// What of a task's kind an educator may choose, and what it asks of the trainee.
struct EngineOptions {
  Engine engine;
  bool side, person_by_mouse, surface;
};
constexpr EngineOptions kKinds[] = {
    {Engine::needle, true, true, false},    {Engine::palpation, false, true, true},
    {Engine::squeeze, false, false, false}, {Engine::search, false, false, false},
    {Engine::friction, false, false, true}, {Engine::pulse, false, false, true},
};

const EngineOptions& kindOf(const TaskChoice& task) {
  return *std::find_if(std::begin(kKinds), std::end(kKinds),
                       [&](const EngineOptions& kind) { return task.engine == kind.engine; });
}

std::vector<std::string> surfacesOf(const TaskChoice& task) {
  if (!kindOf(task).surface || task.real_lump) return {};
  return station::surfacesIn(station::assetFile("materials/surfaces.json"));
}

bool takesFingers(const TaskChoice& task) {
  return task.engine == Engine::palpation && !task.curved && !task.real_lump;
}

bool takesPatient(const TaskChoice& task) { return kindOf(task).side && !task.block; }

void requireSurface(const TaskChoice& task, const std::string& name) {
  const std::vector<std::string> known = surfacesOf(task);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw UsageError("does not lie there", "surface " + name, "Choose one from the list");
}

}  // namespace

std::vector<TaskChoice> taskChoices() {
  std::vector<TaskChoice> all;
  for (const auto& entry : fs::directory_iterator(station::assetFile("tasks"))) {
    if (entry.path().extension() != ".json") continue;
    const JsonFile file(entry.path());
    if (!file.has("engine") || !file.has("id") || !file.has("title")) continue;
    const std::optional<Engine> engine = training::engineNamed(file.text("engine"));
    if (!engine) continue;
    const bool block = *engine == Engine::needle && file.has("phantom");
    all.push_back({file.text("id"), file.text("title"), station::briefOf(file), *engine,
                   entry.path(), file.has("phantom/shape"), block, file.has("real_lump")});
  }
  const auto first = [](const TaskChoice& task) {
    return std::pair(task.id != "paracentesis", task.id);
  };
  std::sort(all.begin(), all.end(),
            [&](const TaskChoice& a, const TaskChoice& b) { return first(a) < first(b); });
  return all;
}

TaskChoice taskChoice(const std::string& id) {
  for (TaskChoice& task : taskChoices())
    if (task.id == id) return std::move(task);
  throw UsageError("is not here", "task " + id, "Choose one from the list");
}

bool takesMouse(const TaskChoice& task) { return kindOf(task).person_by_mouse; }

json described(const TaskChoice& task) {
  const EngineOptions& kind = kindOf(task);
  json options = json::array({"force_feedback"});
  if (takesPatient(task)) options.insert(options.end(), {"side", "patient_seed"});
  if (task.engine == Engine::friction) options.push_back("sort");
  if (takesFingers(task)) options.push_back("fingers");
  return {{"id", task.id},
          {"title", task.title},
          {"engine", training::nameOf(task.engine)},
          {"about", task.brief},
          {"options", options},
          {"station", nameOf(stationKindOf(task.engine))},
          {"surfaces", surfacesOf(task)},
          {"assessable", true},
          {"by_mouse", kind.person_by_mouse}};
}

std::vector<std::string> argumentsOf(const TaskChoice& task, const SessionWish& wish) {
  std::vector<std::string> a{"train",
                             "--task",
                             task.file.string(),
                             "--operator",
                             wish.performer,
                             "--trials",
                             std::to_string(wish.trials),
                             "--seed",
                             std::to_string(wish.seed),
                             "--force-feedback",
                             wish.force_feedback ? "on" : "off"};
  if (wish.assess) a.push_back("--assess");
  if (wish.sort && task.engine == Engine::friction) a.push_back("--sort");
  if (wish.fingers > 1 && takesFingers(task))
    a.insert(a.end(), {"--tools", std::to_string(wish.fingers)});
  if (!wish.surface.empty()) {
    requireSurface(task, wish.surface);
    a.insert(a.end(), {"--surface", wish.surface});
  }
  if (!takesPatient(task)) return a;
  a.insert(a.end(), {"--side", wish.side});
  if (wish.patient_seed > 0)
    a.insert(a.end(), {"--patient-seed", std::to_string(wish.patient_seed)});
  return a;
}

}  // namespace palpa::console
