#include <algorithm>

#include "anatomy/geometry/error.h"
#include "apps/console/routes.h"
#include "apps/live/steering.h"
#include "apps/station/assets.h"
#include "apps/station/json_file.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Task {
  std::string id, title, engine;
  fs::path file;
};

/// What of a task's kind an educator may choose, and what it asks of the trainee.
struct Kind {
  const char *engine, *about;
  bool side, person_by_mouse;
};
constexpr Kind kKinds[] = {
    {"needle", "Lead a needle to a target that is felt, and seen over the camera's picture.", true,
     true},
    {"palpation", "Search a soft phantom for lumps: they are felt, though the silicone has none.",
     false, true},
    {"squeeze", "Between two fingers: which is harder, which is heavier?", false, false},
    {"surface", "Find the rough one of three hidden things by touch.", false, false},
};

const Kind* kindOf(const std::string& engine) {
  const Kind* found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                   [&](const Kind& kind) { return engine == kind.engine; });
  return found == std::end(kKinds) ? nullptr : found;
}

std::vector<Task> tasks() {
  std::vector<Task> all;
  for (const auto& entry : fs::directory_iterator(station::assetFile("tasks"))) {
    if (entry.path().extension() != ".json") continue;
    const station::JsonFile file(entry.path());
    if (!file.has("engine") || !file.has("id") || !file.has("title") ||
        !kindOf(file.text("engine")))
      continue;
    all.push_back({file.text("id"), file.text("title"), file.text("engine"), entry.path()});
  }
  const auto first = [](const Task& task) { return std::pair(task.id != "paracentesis", task.id); };
  std::sort(all.begin(), all.end(),
            [&](const Task& a, const Task& b) { return first(a) < first(b); });
  return all;
}

json told(const Task& task) {
  const Kind& kind = *kindOf(task.engine);
  json options = json::array({"force_feedback"});
  if (kind.side) options.insert(options.end(), {"side", "patient_seed"});
  return {{"id", task.id},
          {"title", task.title},
          {"engine", task.engine},
          {"about", kind.about},
          {"options", options},
          {"assessable", true},
          {"by_mouse", kind.person_by_mouse}};
}

std::vector<std::string> argumentsOf(const Console& c, const SessionWish& wish) {
  const auto all = tasks();
  const auto task =
      std::find_if(all.begin(), all.end(), [&](const Task& one) { return one.id == wish.task; });
  if (task == all.end())
    throw UsageError("is not here", "task " + wish.task, "Choose one of the list");
  if (wish.performer == "person" && !c.place.display && stationOf(c.place).empty())
    throw UsageError("needs a window at the station, and there is no display",
                     "a person on the virtual bench", "Choose a simulated expert or novice");
  std::vector<std::string> a{"train",
                             "--task",
                             task->file.string(),
                             "--operator",
                             wish.performer,
                             "--trials",
                             std::to_string(wish.trials),
                             "--seed",
                             std::to_string(wish.seed),
                             "--force-feedback",
                             wish.force_feedback ? "on" : "off"};
  if (wish.performer != "person" || !c.place.display) a.insert(a.end(), {"--display", "offscreen"});
  if (!wish.trainee.empty())
    a.insert(a.end(), {"--trainee", wish.trainee, "--records", c.place.records});
  if (wish.assess) a.push_back("--assess");
  if (kindOf(task->engine)->side) a.insert(a.end(), {"--side", wish.side});
  if (kindOf(task->engine)->side && wish.patient_seed > 0)
    a.insert(a.end(), {"--patient-seed", std::to_string(wish.patient_seed)});
  if (const std::string chosen = stationOf(c.place); !chosen.empty())
    a.insert(a.end(), {"--station", chosen, "--bench-seed",
                       "1"});  // calibrated from here: with the bench's first seed
  return a;
}

void command(Console& c, const std::string& id, const httplib::Request& request,
             httplib::Response& response) {
  bodyOf(request);
  live::parseSteering(request.body);  // refused here what the session would refuse
  const auto link = c.sessions.link(id);
  if (!link || !link->send(request.body))
    return refuse(response, 409, "the session is not running (any more)");
  answer(response, json::object(), 202);
}

}  // namespace

void addSessionRoutes(WebServer& server, Console& c) {
  server.Get("/api/tasks", [](const httplib::Request&, httplib::Response& r) {
    json all = json::array();
    for (const Task& task : tasks()) all.push_back(told(task));
    answer(r, all);
  });
  server.Get("/api/sessions",
             [&c](const httplib::Request&, httplib::Response& r) { answer(r, c.sessions.list()); });
  server.Post("/api/sessions", [&c](const httplib::Request& q, httplib::Response& r) {
    SessionWish wish = readWish(bodyOf(q));
    wish.simulated = isSimulated(c, wish.performer);
    if (c.sessions.oneRuns())
      return refuse(r, 409, "a session is running already: end it first, or wait until it is over");
    answer(r, {{"id", c.sessions.begin(wish, argumentsOf(c, wish))}}, 201);
  });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               answer(r, c.sessions.one(q.matches[1]));
             });
  server.Post(
      R"(/api/sessions/([A-Za-z0-9_-]{1,64})/command)",
      [&c](const httplib::Request& q, httplib::Response& r) { command(c, q.matches[1], q, r); });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/file/([A-Za-z0-9_.-]{1,80}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               const std::string name = q.matches[2];
               if (!isShown(name)) return refuse(r, 404, "is not here");
               sendFile(r, c.sessions.shown(q.matches[1]) / name, mediaTypeOf(name));
             });
}

}  // namespace palpa::console
