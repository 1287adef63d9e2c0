
#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/jobs.h"
#include "apps/console/routes.h"
#include "apps/station/station_file.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct CalibrationStep {
  const char *id, *title, *what;
};
constexpr CalibrationStep kSteps[] = {
    {"camera", "Camera",
     "Hold the printed board in front of the camera, near and far, tilted, in every corner of "
     "the picture, until the picture is covered."},
    {"workspace", "Device",
     "Touch the points of the grid one after the other. This measures how far off the device is "
     "from place to place."},
    {"tool", "Needle or probe",
     "Rest the tip in one place and swing the tool about it; then spin it about its own length. "
     "This finds the tip and the direction."},
    {"registration", "Where the device stands",
     "Touch the marked points on the board. This ties what is felt to what is seen."},
    {"latency", "Delay between seen and felt",
     "Move the tool to and fro in front of the camera for some seconds."},
    {"force-sensor", "Force sensor",
     "Hold the tool still in different directions. This finds what the sensor shows without a "
     "load, and the tool's weight."},
};

std::string textIn(const fs::path& file) { return readWhole(file).value_or(""); }

/// A station as the pages take it: what it is for, and whether what is done there is scored.
json described(const Console& c, StationKind kind) {
  json one{{"kind", nameOf(kind)}, {"for", titleOf(kind)}};
  try {
    const station::Station station = stationNow(c.place, kind);
    one["title"] = station.title;
    one["simulated"] = station.simulated;
    one["bench"] = station.device.driver == station::DeviceDriver::bench;
    one["measured"] = !station.calibrations.empty();
    one["trouble"] = station.calibrationProblem();
  } catch (const Error& e) {
    one["title"] = titleOf(kind);
    one["simulated"] = false;
    one["measured"] = false;
    one["trouble"] = e.what();
  }
  return one;
}

json me(const Console& c, bool entered) {
  json all{{"version", c.place.version}, {"entered", entered}, {"page_key", c.guard.pageKey()}};
  if (!entered) return all;
  all["display"] = c.place.display;
  all["room_camera"] = !c.place.room_camera.empty();
  all["open_to_others"] = c.openToOthers();
  all["stations"] = json::array();
  for (const StationKind kind : kStationKinds) all["stations"].push_back(described(c, kind));
  all["room"] = {{"watches", c.watch != nullptr},
                 {"station", c.joined ? c.joined->name() : ""},
                 {"trouble", c.room_trouble}};
  return all;
}

json health(Console& c) {
  const std::lock_guard lock(c.health.mutex);
  json all{{"state", c.health.job.empty() ? "done" : "checking"},
           {"checked_utc", c.health.checked_utc}};
  if (c.health.findings.is_object()) {
    all["can_start"] = c.health.findings.value("can_start", false);
    all["findings"] = c.health.findings.value("findings", json::array());
  } else {
    all["findings"] = json::array();
  }
  return all;
}

/// Whether this station has what the step touches or looks at.
bool takes(const station::Station& station, const std::string& step) {
  if (step == "workspace") return !station.grid.empty();
  if (step == "tool" || step == "registration") return !station.landmarks.empty();
  if (step == "latency") return station.marker.has_value();
  if (step == "force-sensor") return station.force_sensor.has_value();
  return true;
}

/// Whether all that `palpa calibrate all` does can be done there; a sensor only where there is one.
bool takesAll(const station::Station& station) {
  return std::all_of(std::begin(kSteps), std::end(kSteps), [&](const CalibrationStep& step) {
    return takes(station, step.id) || step.id == std::string("force-sensor");
  });
}

json calibration(Console& c, StationKind kind) {
  const char* const blocked =
      c.sessions.oneRuns() ? "A session is running. Calibrate when it is over." : "";
  json all{{"job", c.jobs.workingOn("calibrate")},
           {"blocked", blocked},
           {"kind", nameOf(kind)},
           {"stations", json::array()},
           {"steps", json::array()},
           {"calibrations", json::array()}};
  json stands;
  for (const StationKind one : kStationKinds) {
    all["stations"].push_back(described(c, one));
    if (one == kind) stands = all["stations"].back();
  }
  if (!stands.contains("bench")) {  // it cannot be read
    all["station"] = stands["title"];
    all["verdict"] = stands["trouble"];
    all["all"] = false;
    return all;
  }
  const station::Station station = stationNow(c.place, kind);
  for (const CalibrationStep& step : kSteps)
    if (takes(station, step.id))
      all["steps"].push_back({{"id", step.id}, {"title", step.title}, {"what", step.what}});
  all["all"] = takesAll(station);
  all["station"] = station.title;
  all["verdict"] = station.calibration_verdict;
  for (const auto& one : station.calibrations)
    all["calibrations"].push_back({{"name", nameOf(one.file.kind)},
                                   {"made_utc", one.file.date},
                                   {"verdict", one.file.verdict},
                                   {"simulated", one.file.simulated}});
  return all;
}

/// A calibration that left a station file makes it the station of its kind.
std::string calibrate(Console& c, StationKind kind, const std::string& step) {
  const CalibrationStep* const found =
      std::find_if(std::begin(kSteps), std::end(kSteps),
                   [&](const CalibrationStep& one) { return step == one.id; });
  if (step != "all" && found == std::end(kSteps))
    throw UsageError("is not a calibration step", step.substr(0, 32), "Choose one from the list");
  const station::Station station = stationNow(c.place, kind);
  if (step == "all" ? !takesAll(station) : !takes(station, step))
    throw UsageError("cannot be done at this station", step, "Choose one from the list");
  if (c.sessions.oneRuns())
    throw UsageError("a session is running", "calibration cannot start",
                     "Calibrate when it is over");
  if (!c.jobs.workingOn("calibrate").empty())
    throw UsageError("another one is running", "calibration cannot start",
                     "Wait until it is over, or stop it");
  JobRequest request;
  request.key = "calibrate";
  request.title = step == "all" ? "Everything" : found->title;
  const fs::path place = c.place.home / "stations" / newId();
  request.picture = "camera.jpg";
  request.arguments = {"calibrate", step,
                       "--out",     place.string(),
                       "--watch",   "{}/" + request.picture,
                       "--station", stationPath(c.place, kind).string()};
  request.page = (place / "calibration.html").string();
  request.then = [&c, kind, place](const fs::path&, bool good) {
    std::error_code none;
    if (good && fs::exists(place / "station.json", none))
      chooseStation(c.place, kind, (place / "station.json").string());
  };
  return c.jobs.add(std::move(request));
}

}  // namespace

void sendFile(httplib::Response& response, const fs::path& file, const std::string& type) {
  std::error_code none;
  if (!fs::is_regular_file(file, none) || fs::is_symlink(file, none))
    return refuse(response, 404, "is not here");
  response.set_content(textIn(file), type);
}

json pageOf(const json& job) {
  return {{"state", job.at("state")},
          {"page", job.at("page")},
          {"message", job.at("message")},
          {"done", job.at("done")}};
}

void checkHealth(Console& c) {
  JobRequest request;
  request.key = "doctor";
  request.title = "Check of the station";
  request.arguments = {"doctor",        "--json", "--records",
                       c.place.records, "--out",  c.place.sessions().string()};
  try {
    const std::string chosen = stationFile(c.place, StationKind::needle);
    if (!chosen.empty()) request.arguments.insert(request.arguments.end(), {"--station", chosen});
  } catch (const Error&) {  // the page of calibrations says what is wrong with the settings
  }
  request.then = [&c](const fs::path& folder, bool) {
    const std::string text = textIn(folder / "log.txt");
    const std::size_t begin = text.find('{'), end = text.rfind('}');
    json found = begin == std::string::npos || end == std::string::npos
                     ? json()
                     : parsedOrDiscarded(text.substr(begin, end - begin + 1));
    if (!found.is_object())
      found = {{"can_start", false},
               {"findings",
                {{{"subject", "check of the station"},
                  {"state", "ill"},
                  {"verdict", complaintIn(folder / "log.txt")},
                  {"fix", "Check again; if it stays so, run palpa doctor in a terminal"}}}}};
    const std::lock_guard lock(c.health.mutex);
    c.health.findings = std::move(found);
    c.health.checked_utc = utcNow();
    c.health.job.clear();
  };
  const std::lock_guard lock(c.health.mutex);
  c.health.job = c.jobs.add(std::move(request));
}

void addStationRoutes(WebServer& server, Console& c) {
  server.Get("/api/me", [&c](const httplib::Request& q, httplib::Response& r) {
    answer(r, me(c, c.guard.entered(q.get_header_value("Cookie"))));
  });
  server.Post("/api/enter", [&c](const httplib::Request& q, httplib::Response& r) {
    const json body = bodyOf(q);
    const std::string cookie = c.guard.enter(q.remote_addr, body.value("token", json()).is_string()
                                                                ? body["token"].get<std::string>()
                                                                : "");
    if (cookie.empty())
      return refuse(r, 403, "that is not the token; after five wrong ones wait a minute");
    r.set_header("Set-Cookie", c.guard.cookieText("palpa", cookie));
    answer(r, json::object());
  });
  server.Get("/api/health",
             [&c](const httplib::Request&, httplib::Response& r) { answer(r, health(c)); });
  server.Post("/api/health", [&c](const httplib::Request&, httplib::Response& r) {
    checkHealth(c);
    answer(r, json::object(), 202);
  });
  server.Get("/api/calibration", [&c](const httplib::Request& q, httplib::Response& r) {
    const std::string kind = q.get_param_value("kind");
    answer(r, calibration(c, kind.empty() ? StationKind::needle : stationKindNamed(kind)));
  });
  server.Post("/api/calibration", [&c](const httplib::Request& q, httplib::Response& r) {
    const json body = bodyOf(q);
    const auto word = [&](const char* field) {
      return body.value(field, json()).is_string() ? body[field].get<std::string>() : "";
    };
    const std::string kind = word("kind");
    answer(r,
           {{"job", calibrate(c, kind.empty() ? StationKind::needle : stationKindNamed(kind),
                              word("step"))}},
           202);
  });
  server.Get(R"(/api/jobs/([A-Za-z0-9_-]{1,64}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               answer(r, c.jobs.one(q.matches[1]));
             });
  server.Post(R"(/api/jobs/([A-Za-z0-9_-]{1,64})/stop)",
              [&c](const httplib::Request& q, httplib::Response& r) {
                c.jobs.stop(q.matches[1]);
                answer(r, json::object(), 202);
              });
  server.Get(R"(/api/jobs/([A-Za-z0-9_-]{1,64})/picture)",
             [&c](const httplib::Request& q, httplib::Response& r) {
               sendFile(r, c.jobs.picture(q.matches[1]), "image/jpeg");
             });
  server.Get(R"(/api/pages/([A-Za-z0-9_-]{1,64}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               sendPage(c, q, r, c.jobs.page(q.matches[1]));
             });
}

}  // namespace palpa::console
