#include <algorithm>
#include <string>

#include "anatomy/base/error.h"
#include "apps/console/routes.h"
#include "apps/record/store/record_store.h"

/// What trainees see on a device of their own: their sessions, each one's report, how they stand.
/// Nothing of anybody else, nothing of a study, nothing that can be changed.
namespace palpa::console {
namespace {

using nlohmann::json;

/// Empty: nobody, or somebody who was deleted since.
std::string whose(const Console& c, const httplib::Request& q) {
  const std::string trainee = c.guard.own().traineeOf(q.get_header_value("Cookie"));
  const bool known =
      !trainee.empty() && record::RecordStore(c.place.records).trainee(trainee).has_value();
  return known ? trainee : "";
}

/// Of a study nothing: its report could tell a trainee what was drawn.
bool isOwn(const json& session, const std::string& trainee) {
  return session.value("trainee", "") == trainee && session["study"] != true &&
         session["state"] == "finished";
}

json mine(Console& c, const std::string& trainee) {
  json sessions = json::array();
  for (const json& one : c.sessions.list()) {
    if (!isOwn(one, trainee)) continue;
    json told;
    for (const char* field :
         {"id", "task", "title", "started_utc", "assessed", "simulated", "outcome"})
      told[field] = one.value(field, json());
    sessions.push_back(std::move(told));
  }
  return {{"trainee", trainee}, {"sessions", sessions}};
}

bool hasOwn(Console& c, const std::string& trainee, const std::string& id) {
  const json all = c.sessions.list();
  return !trainee.empty() && std::any_of(all.begin(), all.end(), [&](const json& one) {
    return one["id"] == id && isOwn(one, trainee);
  });
}

json newPin(Console& c, const std::string& trainee) {
  if (!record::RecordStore(c.place.records).trainee(trainee))
    throw UsageError("is not in the records", "trainee " + trainee, "Choose one from the list");
  if (!c.openToOthers())
    throw UsageError("can be reached from this computer only", "this console",
                     "Start it with --listen and --token-file");
  return {{"pin", c.guard.own().pinFor(trainee)}, {"minutes", OwnDoor::kPinLasts.count()}};
}

void enterAsOneself(Console& c, const httplib::Request& q, httplib::Response& r) {
  const json body = bodyOf(q);
  const std::string key = c.guard.own().enter(q.remote_addr, body.value("pin", json()).is_string()
                                                                 ? body["pin"].get<std::string>()
                                                                 : std::string());
  if (key.empty())
    return refuse(r, 403,
                  "that PIN does not work: it was used, or is older than ten minutes; after five "
                  "wrong ones wait a minute");
  r.set_header("Set-Cookie", c.guard.cookieText("palpa-mine", key));
  answer(r, json::object());
}

}  // namespace

void addOwnRoutes(WebServer& server, Console& c) {
  server.Post(R"(/api/trainees/([A-Za-z0-9_-]{1,32})/pin)",
              [&c](const httplib::Request& q, httplib::Response& r) {
                bodyOf(q);
                answer(r, newPin(c, q.matches[1]));
              });
  server.Post("/api/mine/enter",
              [&c](const httplib::Request& q, httplib::Response& r) { enterAsOneself(c, q, r); });
  server.Post("/api/mine/leave", [&c](const httplib::Request& q, httplib::Response& r) {
    c.guard.own().leave(q.get_header_value("Cookie"));
    r.set_header("Set-Cookie", c.guard.cookieText("palpa-mine", "", "; Max-Age=0"));
    answer(r, json::object());
  });
  server.Get("/api/mine", [&c](const httplib::Request& q, httplib::Response& r) {
    const std::string trainee = whose(c, q);
    if (trainee.empty()) return answer(r, {{"trainee", ""}, {"sessions", json::array()}});
    answer(r, mine(c, trainee));
  });
  server.Get(R"(/api/mine/([A-Za-z0-9_-]{1,64})/file/report\.html)",
             [&c](const httplib::Request& q, httplib::Response& r) {
               if (!hasOwn(c, whose(c, q), q.matches[1]))
                 return refuse(r, 404, "is not one of your sessions");
               sendPage(c, q, r, c.sessions.shown(q.matches[1]) / "report.html");
             });
}

}  // namespace palpa::console
