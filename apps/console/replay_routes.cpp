#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "apps/console/routes.h"
#include "apps/live/live_sink.h"
#include "apps/record/session_file.h"

namespace palpa::console {

using runtime::EventKind;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr int kPicturesPerSecond = 5;
constexpr char kSize[] = "960x540";

double rounded(double value) { return std::isfinite(value) ? std::round(value * 1e3) / 1e3 : 0; }

/// In the trial's own time: as it was judged, pauses left out.
json curvesOf(const live::ForceCurve& curve, const training::TrialTimes& times) {
  json t = json::array(), force = t, depth = t;
  for (const live::ForceCurve::Point& point : curve.points()) {
    t.push_back(rounded(times.at(std::llround(point.t_s * 1e9))));
    force.push_back(rounded(point.force_N));
    depth.push_back(rounded(point.depth_mm));
  }
  return {{"t_s", t}, {"force_N", force}, {"depth_mm", depth}};
}

/// A needle's phases out of its events: each lasts until the next.
json phasesIn(const std::vector<runtime::Event>& events, const record::RecordedTrial& trial,
              const training::TrialTimes& times) {
  json all = json::array();
  for (const runtime::Event& event : events) {
    if (event.trial != trial.header.trial || !event.is(EventKind::phase)) continue;
    const double t_s = rounded(times.at(event.t_ns));
    if (!all.empty()) all.back()["to_s"] = t_s;
    all.push_back({{"from_s", t_s}, {"to_s", rounded(times.length_s())}, {"name", event.text}});
  }
  return all;
}

/// A note belongs to the trial that it is about, whenever it was sent.
bool isOf(const record::RecordedTrial& trial, const runtime::Event& event) {
  if (!event.is(EventKind::note)) return event.trial == trial.header.trial;
  return trial.header.t_ns <= event.about_ns() && !trial.isOver(event.about_ns());
}

json eventsIn(const std::vector<runtime::Event>& events, const record::RecordedTrial& trial,
              const training::TrialTimes& times, const live::ToneOf& tone) {
  json all = json::array();
  for (const runtime::Event& event : events)
    if (isOf(trial, event) && !event.is(EventKind::trial_case) && !event.is(EventKind::picture))
      all.push_back({{"t_s", rounded(times.at(event.about_ns()))},
                     {"event", event.kind},
                     {"text", event.text},
                     {"tone", tone(event)}});
  return all;
}

/// Near misses out of what the pictures' command found.
json nearIn(const json& pictures) {
  json near = json::array();
  for (const json& mark : pictures.value("marks", json::array()))
    if (mark.value("near_miss", false))
      near.push_back({{"t_s", mark.at("t_s")}, {"text", mark.at("text")}});
  return near;
}

struct Recorded {
  fs::path evidence, pictures;
  std::string key;
};

Recorded recorded(Console& c, const std::string& id, int number) {
  const fs::path folder = c.sessions.folder(id);
  return {c.sessions.shown(id) / "session.palpa", folder / ("replay-" + std::to_string(number)),
          "replay " + id + " " + std::to_string(number)};
}

/// Those of a trial that are there while the rest is being drawn: in their order, each whole.
int drawnSoFar(const fs::path& pictures) {
  std::error_code none;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(pictures, none))
    count += entry.path().extension() == ".jpg";
  return count;
}

/// Pictures are drawn once, by the command that draws films.
void drawPictures(Console& c, const Recorded& trial, int number, json* told) {
  std::error_code none;
  (*told)["ready"] = fs::exists(trial.pictures / "pictures.json", none);
  (*told)["track"] = fs::exists(trial.pictures / "track.json", none);
  if ((*told)["ready"]) {
    const json pictures = JsonFile(trial.pictures / "pictures.json").json();
    (*told)["frames"] = pictures.value("pictures", 0);
    (*told)["near"] = nearIn(pictures);
    (*told)["done"] = 1;
    (*told)["drawn"] = (*told)["frames"];
    return;
  }
  const json state = c.jobs.ask(
      {trial.key,
       "Pictures of a trial",
       {"replay", trial.evidence.string(), "--trial", std::to_string(number), "--pictures",
        trial.pictures.string(), "--fps", std::to_string(kPicturesPerSecond), "--size", kSize},
       "",
       {}});
  (*told)["done"] = state["done"].is_number() ? state["done"] : json(0);
  (*told)["drawn"] = drawnSoFar(trial.pictures);
  if (state["state"] != "failed") return;
  (*told)["ready"] = true;  // there will be none: what stands beside them is all there is
  (*told)["frames"] = 0;
  (*told)["trouble"] = state["message"];
}

json toldOf(const record::SessionReader& reader, const record::RecordedTrial& trial,
            const live::ToneOf& tone) {
  const int number = trial.header.trial;
  live::ForceCurve curve;
  auto all = record::trialTimes(reader, [&](const haptics::FlightRecord& tick) {
    if (tick.commands.trial == static_cast<std::uint32_t>(number)) curve.add(tick);
  });
  const training::TrialTimes times = all[number];
  json told = curvesOf(curve, times);
  const double length_s = times.length_s();
  const std::vector<runtime::Event> events = reader.events();
  told["length_s"] = rounded(length_s);
  told["events"] = eventsIn(events, trial, times, tone);
  told["phases"] = phasesIn(events, trial, times);
  told["fps"] = kPicturesPerSecond;
  told["frames"] = std::max(1, static_cast<int>(std::lround(length_s * kPicturesPerSecond)));
  return told;
}

/// The trials read last: a page asks again and again while pictures are drawn, and what is over
/// changes no more.
class ReadTrials {
 public:
  json of(const Recorded& where, int number, const live::ToneOf& tone) {
    const std::lock_guard lock(mutex_);
    for (const auto& [key, told] : kept_)
      if (key == where.key) return told;
    const record::SessionReader reader(where.evidence);
    for (const record::RecordedTrial& trial : reader.trials()) {
      if (trial.header.trial != number) continue;
      kept_.emplace_front(where.key, toldOf(reader, trial, tone));
      if (kept_.size() > kMost) kept_.pop_back();
      return kept_.front().second;
    }
    throw UsageError("is not in the session", "trial " + std::to_string(number),
                     "Choose one from the list");
  }

 private:
  static constexpr std::size_t kMost = 4;  // one and an expert's beside, of two pages
  std::mutex mutex_;
  std::deque<std::pair<std::string, json>> kept_;
};

/// `all`: else only how far its pictures are, for a page that has the rest.
json replay(Console& c, ReadTrials& read, const std::string& id, int number, bool all) {
  const Recorded where = recorded(c, id, number);
  if (const auto link = c.sessions.link(id);
      link && !link->wait(0, std::chrono::milliseconds(0)).over)
    throw UsageError("is still running", "the session",
                     "Its trials can be seen again when it is over");
  json told = read.of(where, number, c.tone);  // refuses a trial that is not there
  if (!all) told = json::object();
  drawPictures(c, where, number, &told);
  return told;
}

}  // namespace

void addReplayRoutes(WebServer& server, Console& c) {
  const auto read = std::make_shared<ReadTrials>();
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/trials/([0-9]{1,5})/replay)",
             [&c, read](const httplib::Request& q, httplib::Response& r) {
               answer(r,
                      replay(c, *read, q.matches[1], static_cast<int>(wholeNumber(q.matches[2], 0)),
                             q.get_param_value("only") != "pictures"));
             });
  const auto drawn = [&c](const httplib::Request& q) {
    return recorded(c, q.matches[1], static_cast<int>(wholeNumber(q.matches[2], 0))).pictures;
  };
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/trials/([0-9]{1,5})/track)",
             [drawn](const httplib::Request& q, httplib::Response& r) {
               sendFile(r, drawn(q) / "track.json", "application/json");
             });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/trials/([0-9]{1,5})/frame/([0-9]{1,5}))",
             [drawn](const httplib::Request& q, httplib::Response& r) {
               char name[32];
               std::snprintf(name, sizeof name, "picture-%05zu.jpg", wholeNumber(q.matches[3], 0));
               sendFile(r, drawn(q) / name, "image/jpeg");
             });
}

}  // namespace palpa::console
