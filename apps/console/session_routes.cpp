#include "anatomy/base/error.h"
#include "apps/console/routes.h"
#include "apps/console/sessions.h"
#include "apps/console/task_choices.h"
#include "apps/live/wire.h"
#include "apps/record/store/record_store.h"

namespace palpa::console {

namespace {

std::string textIn(const nlohmann::json& asked, const char* field, const std::string& otherwise) {
  if (!asked.contains(field)) return otherwise;
  if (!asked[field].is_string()) throw UsageError("is not text", field, "Load the page again");
  return asked[field];
}

bool flagIn(const nlohmann::json& asked, const char* field, bool otherwise) {
  if (!asked.contains(field)) return otherwise;
  if (!asked[field].is_boolean())
    throw UsageError("is neither true nor false", field, "Load the page again");
  return asked[field];
}

std::uint64_t numberIn(const nlohmann::json& asked, const char* field, std::uint64_t otherwise,
                       std::uint64_t least, std::uint64_t most) {
  if (!asked.contains(field)) return otherwise;
  const auto& value = asked[field];
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() < least ||
      value.get<std::uint64_t>() > most)
    throw UsageError(
        "is not a whole number from " + std::to_string(least) + " to " + std::to_string(most),
        field, "Change it");
  return value;
}

void requireOneOf(const std::string& value, const char* field,
                  std::initializer_list<const char*> known) {
  std::string names;
  for (const char* name : known) {
    if (value == name) return;
    names += names.empty() ? name : std::string(", ") + name;
  }
  throw UsageError("is not one of " + names, field, "Choose one of them");
}

}  // namespace

SessionWish readWish(const nlohmann::json& asked) {
  constexpr std::uint64_t kMostSeed = 1'000'000'000;
  SessionWish wish;
  wish.task = textIn(asked, "task", "");
  if (!isId(wish.task)) throw UsageError("was not chosen", "task", "Choose one");
  wish.trainee = textIn(asked, "trainee", "");
  if (!wish.trainee.empty())
    if (const std::string why = record::whyNoPseudonym(wish.trainee); !why.empty())
      throw UsageError(why, "trainee", "Choose one from the list");
  wish.performer = textIn(asked, "operator", "person");
  requireOneOf(wish.performer, "operator", {"person", "expert", "novice"});
  wish.side = textIn(asked, "side", "right");
  requireOneOf(wish.side, "side", {"right", "left"});
  wish.assess = flagIn(asked, "assess", false);
  wish.force_feedback = flagIn(asked, "force_feedback", true);
  wish.sort = flagIn(asked, "sort", false);
  wish.film = flagIn(asked, "film", false);
  wish.fingers = static_cast<int>(numberIn(asked, "fingers", 1, 1, 2));
  wish.surface = textIn(asked, "surface", "");
  wish.trials = static_cast<int>(numberIn(asked, "trials", 1, 1, 50));
  wish.seed = numberIn(asked, "seed", 1, 0, kMostSeed);
  wish.patient_seed = numberIn(asked, "patient_seed", 0, 0, kMostSeed);
  return wish;
}

namespace {

using nlohmann::json;

std::vector<std::string> sessionCommand(const Console& c, const TaskChoice& task,
                                        const SessionWish& wish) {
  const StationKind kind = stationKindOf(task.engine);
  if (wish.performer == "person" && !c.place.display && stationFile(c.place, kind).empty())
    throw UsageError("needs a window at the station, and there is no display",
                     "a person on the virtual bench", "Choose a simulated expert or novice");
  if (wish.performer == "person" && !takesMouse(task) && onBench(c.place, kind))
    throw UsageError("cannot hold this task's tool with a mouse", "a person on the virtual bench",
                     "Choose a simulated expert or novice, or a station with a haptic device");
  std::vector<std::string> a = argumentsOf(task, wish);
  if (wish.performer != "person" || !c.place.display) a.insert(a.end(), {"--display", "offscreen"});
  if (!wish.trainee.empty())
    a.insert(a.end(), {"--trainee", wish.trainee, "--records", c.place.records});
  if (wish.film && c.place.room_camera.empty())
    throw UsageError("is not known here", "a camera in the room",
                     "Begin the console with --room-camera");
  if (wish.film && wish.trainee.empty() && wish.performer == "person")
    throw UsageError("a film belongs to a trainee's records", "the room cannot be filmed",
                     "Choose the trainee, who has to agree");
  if (wish.film) a.insert(a.end(), {"--film-room", c.place.room_camera, "--film-agreed"});
  if (wish.silent) a.insert(a.end(), {"--sound", "off"});
  if (!wish.language.empty()) a.insert(a.end(), {"--language", wish.language});
  addStation(c.place, kind, &a);
  return a;
}

/// Nothing here waits for a file, a database or another request.
void stopNow(Console& c, const std::string& id, httplib::Response& response) {
  const auto link = c.sessions.linkForStop(id);
  switch (link ? link->stop() : SessionLink::Stopped::nobody) {
    case SessionLink::Stopped::yes:
      return answer(response, json{{"confirmed", true}}, 202);
    case SessionLink::Stopped::unconfirmed:
      return refuse(response, 504,
                    "the session was told to stop and has not confirmed it: use the stop at the "
                    "station itself");
    case SessionLink::Stopped::nobody:
      return refuse(response, 409, "the session is not running (any more)");
  }
}

void command(Console& c, const std::string& id, const httplib::Request& request,
             httplib::Response& response) {
  bodyOf(request);
  // Refused here what the session would refuse.
  if (live::parseSteering(request.body).command == trial::UserCommand::emergency_stop)
    return stopNow(c, id, response);
  const auto link = c.sessions.link(id);
  if (!link || !link->send(request.body))
    return refuse(response, 409, "the session is not running (any more)");
  answer(response, json::object(), 202);
}

/// Report and table of a session whose program died, by the command that makes them.
void finish(Console& c, const std::string& id, httplib::Response& response) {
  if (c.sessions.one(id)["state"] != "interrupted")
    return refuse(response, 409, "there is no report to make: the session is running, or has one");
  answer(response,
         {{"job", c.jobs.add({"finish " + id,
                              "Report of a session",
                              {"finish", c.sessions.results(id).string()},
                              "",
                              {}})}},
         202);
}

}  // namespace

std::string beginSession(Console& c, SessionWish wish) {
  const TaskChoice task = taskChoice(wish.task);
  wish.title = task.title;
  wish.simulated = isSimulated(c.place, stationKindOf(task.engine), wish.performer);
  return c.sessions.begin(wish, sessionCommand(c, task, wish));
}

void addSessionRoutes(WebServer& server, Console& c) {
  server.Get("/api/tasks", [](const httplib::Request&, httplib::Response& r) {
    json all = json::array();
    for (const TaskChoice& task : taskChoices()) all.push_back(described(task));
    answer(r, all);
  });
  server.Get("/api/sessions",
             [&c](const httplib::Request&, httplib::Response& r) { answer(r, c.sessions.list()); });
  server.Post("/api/sessions", [&c](const httplib::Request& q, httplib::Response& r) {
    SessionWish wish = readWish(bodyOf(q));
    wish.language = languageOfWhoAsks(c, q);
    if (c.sessions.oneRuns())
      return refuse(r, 409, "a session is running already: end it first, or wait until it is over");
    answer(r, {{"id", beginSession(c, wish)}}, 201);
  });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               answer(r, c.sessions.one(q.matches[1]));
             });
  server.Post(
      R"(/api/sessions/([A-Za-z0-9_-]{1,64})/command)",
      [&c](const httplib::Request& q, httplib::Response& r) { command(c, q.matches[1], q, r); });
  server.Post(
      R"(/api/sessions/([A-Za-z0-9_-]{1,64})/stop)",
      [&c](const httplib::Request& q, httplib::Response& r) { stopNow(c, q.matches[1], r); });
  server.Post(
      R"(/api/sessions/([A-Za-z0-9_-]{1,64})/finish)",
      [&c](const httplib::Request& q, httplib::Response& r) { finish(c, q.matches[1], r); });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/file/([A-Za-z0-9_.-]{1,80}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               const std::string name = q.matches[2];
               if (!isShown(name)) return refuse(r, 404, "is not here");
               if (name.ends_with(".html"))
                 return sendPage(c, q, r, c.sessions.shown(q.matches[1]) / name);
               sendFile(r, c.sessions.shown(q.matches[1]) / name, mediaTypeOf(name));
             });
}

namespace {

constexpr std::chrono::milliseconds kPatience{1000};
constexpr char kNoPicture[] =
    "belongs to a study whose educators are blinded: a picture could tell what was drawn";
constexpr char kBoundary[] = "palpa-picture";

bool write(httplib::DataSink& sink, const std::string& bytes) {
  return sink.is_writable() && sink.write(bytes.data(), bytes.size());
}

/// Server-sent events: every entry with its number; whoever was away says the last that he has
/// (Last-Event-ID) and gets the rest.
void sendEvents(WebServer& server, const std::shared_ptr<SessionLink>& link, std::size_t from,
                httplib::Response& response) {
  response.set_header("X-Accel-Buffering", "no");
  response.set_chunked_content_provider(
      "text/event-stream",
      [&server, link, next = from](std::size_t, httplib::DataSink& sink) mutable {
        if (server.ending()) return false;
        const SessionLink::News news = link->wait(next, kPatience);
        next = news.from;
        std::string out;
        for (const std::string& entry : news.entries)
          out += "id: " + std::to_string(++next) + "\ndata: " + entry + "\n\n";
        if (out.empty()) out = ": here\n\n";
        if (!write(sink, out)) return false;
        if (news.over && news.entries.empty()) sink.done();
        return true;
      },
      [&server](bool) { server.leaveStream(); });
}

void sendPictures(WebServer& server, const std::shared_ptr<SessionLink>& link,
                  httplib::Response& response) {
  response.set_content_provider(
      std::string("multipart/x-mixed-replace; boundary=") + kBoundary,
      [&server, link, last = std::uint64_t{0}](std::size_t, httplib::DataSink& sink) mutable {
        if (server.ending()) return false;
        const SessionLink::Picture picture = link->picture(last, kPatience);
        if (!picture.jpeg)
          return sink.is_writable() && !link->wait(0, std::chrono::milliseconds(0)).over;
        last = picture.number;
        return write(sink, std::string("--") + kBoundary +
                               "\r\nContent-Type: image/jpeg\r\nContent-Length: " +
                               std::to_string(picture.jpeg->size()) + "\r\n\r\n" + *picture.jpeg +
                               "\r\n");
      },
      [&server](bool) { server.leaveStream(); });
}

std::shared_ptr<SessionLink> linkFor(WebServer& server, Console& c, const std::string& id,
                                     httplib::Response& response) {
  auto link = c.sessions.link(id);
  if (!link) {
    c.sessions.folder(id);
    response.status =
        204;  // over before this console began: nothing live to tell, and no reason to ask again
    return nullptr;
  }
  if (server.enterStream()) return link;
  refuse(response, 503, "too many pages watch at once: close some");
  return nullptr;
}

}  // namespace

void addLiveRoutes(WebServer& server, Console& c) {
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/live)",
             [&server, &c](const httplib::Request& q, httplib::Response& r) {
               if (const auto link = linkFor(server, c, q.matches[1], r))
                 sendEvents(server, link, wholeNumber(q.get_header_value("Last-Event-ID"), 0), r);
             });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/view)",
             [&server, &c](const httplib::Request& q, httplib::Response& r) {
               if (c.sessions.isBlind(q.matches[1])) return refuse(r, 403, kNoPicture);
               if (const auto link = linkFor(server, c, q.matches[1], r))
                 sendPictures(server, link, r);
             });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/picture)",
             [&c](const httplib::Request& q, httplib::Response& r) {
               if (c.sessions.isBlind(q.matches[1])) return refuse(r, 403, kNoPicture);
               const auto link = c.sessions.link(q.matches[1]);
               const SessionLink::Picture picture =
                   link ? link->picture(0, kPatience) : SessionLink::Picture{};
               if (!picture.jpeg) return refuse(r, 404, "there is no picture yet");
               r.set_content(*picture.jpeg, "image/jpeg");
             });
}

}  // namespace palpa::console
