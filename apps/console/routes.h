#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "apps/console/jobs.h"
#include "apps/console/place.h"
#include "apps/console/room_station.h"
#include "apps/console/sessions.h"
#include "apps/console/stations.h"
#include "apps/console/web/web_server.h"
#include "apps/language/languages.h"
#include "apps/live/live_sink.h"
#include "apps/room/nearby.h"
#include "apps/room/watch.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"

namespace palpa::console {

class LearningDesk;

/// The few threads that wait for pictures of other stations at a time, one a station. One that has
/// kept a thread waiting is left in peace for a while: it shall not have all places. Any thread.
class PicturePlaces {
 public:
  using Time = runtime::ServingClock::time_point;
  static constexpr std::size_t kMost = 4;
  static constexpr std::chrono::seconds kSlow{1}, kInPeace{10};

  /// False: there is none for this station now.
  bool take(const std::string& station, Time now);
  void giveBack(const std::string& station, Time taken, Time now);

 private:
  std::mutex mutex_;
  std::set<std::string> asked_;
  std::map<std::string, Time> in_peace_;  ///< until then
};

/// What the routes share.
struct Console {
  Console(ConsolePlace where, Guard& the_guard, live::ToneOf tone_of)
      : place(std::move(where)),
        guard(the_guard),
        tone(std::move(tone_of)),
        sessions(place),
        jobs(place) {}
  /// Others come to it, by a token: a trainee's own device, too.
  bool openToOthers() const { return place.reached && guard.asksForToken(); }
  const ConsolePlace place;
  Guard& guard;
  const live::ToneOf tone;
  Sessions sessions;
  struct Health {  // NOLINT(bugprone-exception-escape): JSON, of which it is made, throws none
    std::mutex mutex;
    nlohmann::json findings;  ///< as `palpa doctor --json` wrote it; null: not yet
    std::string checked_utc, job;
  } health;
  language::Shelf languages{station::assetFile("languages")};
  Jobs jobs;                               ///< its thread uses what is above until it has ended
  std::filesystem::path room;              ///< folder of the room that it watches
  std::string room_trouble;                ///< why it is in none, although it should be
  std::unique_ptr<room::RoomWatch> watch;  ///< of a room, or null
  PicturePlaces picture_places;
  std::unique_ptr<RoomStation> joined;   ///< to a room, or null
  std::unique_ptr<room::Nearby> nearby;  ///< on the network, or null: nobody there matters
  /// Launches of learning management systems; there from before the server answers.
  std::shared_ptr<LearningDesk> learning;
};

/// One function a part of the house's API; each adds its paths to the server.
void addStationRoutes(WebServer& server,
                      Console& console);  ///< me, enter, health, calibration, jobs, pages
void addPeopleRoutes(WebServer& server, Console& console);   ///< trainees, reports, cohort, studies
void addSessionRoutes(WebServer& server, Console& console);  ///< tasks, sessions, commands, files
void addLiveRoutes(WebServer& server, Console& console);     ///< events and pictures as they happen
void addRatingRoutes(WebServer& server, Console& console);   ///< marks of a rater, the verdict
void addReplayRoutes(WebServer& server, Console& console);   ///< a trial on one timeline
void addFilmRoutes(WebServer& server, Console& console);     ///< the film of the room
void addRoomRoutes(WebServer& server, Console& console);     ///< the other stations, and this one
void addOwnRoutes(WebServer& server, Console& console);      ///< a trainee's own results
/// Begins to send what came of launches.
std::shared_ptr<LearningDesk> openLearningDesk(Console& console);
void addLearningRoutes(WebServer& server, Console& console);  ///< launches of an LMS
void addPages(WebServer& server, Console& console);           ///< what a browser loads, languages

void checkHealth(Console& console);
/// Throws UsageError for what cannot be held here, and where a session runs already.
std::string beginSession(Console& console, SessionWish wish);

/// A whole file as an answer; 404 where it is none.
void sendFile(httplib::Response& response, const std::filesystem::path& file,
              const std::string& type);
/// A code: as a browser's cookie says, which a choice on our pages sets, else its Accept-Language.
std::string languageOfWhoAsks(const Console& console, const httplib::Request& request);
/// The same for a page of ours, in the language of who asks.
void sendPage(Console& console, const httplib::Request& request, httplib::Response& response,
              const std::filesystem::path& file);
/// {"state", "page", "message"} of a job that makes a page.
nlohmann::json pageOf(const nlohmann::json& job);

}  // namespace palpa::console
