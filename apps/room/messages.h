#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

/// What stations of a room and the console that watches it tell each other: JSON, by topics of an
/// MQTT broker. All readers throw UsageError for what is no such message.
namespace palpa::room {

/// A name that a topic, a file and a certificate can bear: 1 to 32 letters, digits, - and _.
bool isStationName(std::string_view text);

enum class Topic {
  about,   ///< station, retained: how it is reached
  state,   ///< station, retained: how it stands; its last will, too
  events,  ///< station: what its sessions record, in their order
  heard,   ///< watcher, retained: up to where these came
  asks,    ///< watcher: what it would like
  answers  ///< station: whether that was done
};

/// "palpa/STATION/state"; a station "+" is any.
std::string topicOf(const std::string& station, Topic topic);
struct Addressed {
  std::string station;
  Topic topic;
};
/// Nothing for a topic that is none of these.
std::optional<Addressed> addressedIn(std::string_view topic);

/// How a station is reached.
struct StationFacts {
  /// of its console: "https://HOST:PORT/", or http of this computer alone; empty: nobody else
  /// reaches it
  std::string url;
  std::string authority;  ///< PEM: who vouches for that console's certificate
  /// 32 hexadecimal digits: whoever says them gets the newest picture; others with every start of
  /// the station's console
  std::string picture_key;
  std::string version;  ///< of Palpa there
};
nlohmann::json toJson(const StationFacts& facts);
StationFacts stationFactsIn(std::string_view text);

/// How a station stands.
struct StationState {
  bool present = false;  ///< its console runs
  std::string utc;       ///< when it said so; a last will has none
  std::string session;   ///< id of the one that runs; empty: none
  /// "free", "starting", or of a session: "checking", "waiting", "running", "paused", "ended",
  /// "finished"
  std::string state = "free";
  std::string task, trainee;  ///< its title; a pseudonym
  std::string alarm;          ///< what the station cries out now; empty: nothing
  int trial = 0, trials = 0;
  double elapsed_s = 0;  ///< of the trial
  bool emergency_stop = false, simulated = false, blind = false;
};
nlohmann::json toJson(const StationState& state);
StationState stationStateIn(std::string_view text);
/// What a broker says for a station that is gone.
StationState goneWithoutAWord();

/// An event of a session, as its record has it.
struct Happening {
  std::string session;      ///< the console's id
  std::string record;       ///< its record's UUID: a session of a study has several
  std::int64_t number = 0;  ///< of it among those of its record that are told: 0, 1, ...
  double t_s = 0;           ///< session time
  int trial = 0;
  std::string event, text, tone;
};
nlohmann::json toJson(const Happening& happening);
Happening happeningIn(std::string_view text);

/// Up to where a station's events have come.
struct Heard {
  std::string beyond;  ///< of sessions with an id up to this one nothing more is wanted
  std::string since;   ///< another one: he listens anew, and what was said meanwhile passed him by
  /// Of each session: the newest number of each of its records.
  std::map<std::string, std::map<std::string, std::int64_t>> sessions;

  /// -1: nothing.
  std::int64_t of(const std::string& session, const std::string& record) const;
};
nlohmann::json toJson(const Heard& heard);
Heard heardIn(std::string_view text);

/// What the watcher would like a station to do. A session can be prepared from afar; that force
/// begins takes a key or a button at the station. A stop from afar is a help, never the emergency
/// stop that stands beside the trainee.
struct Ask {
  enum class What { prepare, pause, stop, leave };
  std::string id;       ///< chosen by whoever asks; the answer bears it
  std::string session;  ///< which one is meant; empty: of `prepare`
  What what = What::pause;
  nlohmann::json wish;  ///< of `prepare`: as the station's own page asks for a session
};
const std::string& nameOf(Ask::What what);
nlohmann::json toJson(const Ask& ask);
Ask askIn(std::string_view text);

struct Answer {
  std::string id;
  bool done = false;
  std::string words;  ///< why not
};
nlohmann::json toJson(const Answer& answer);
Answer answerIn(std::string_view text);

/// As it is sent; what is no UTF-8 is replaced.
std::string wire(const nlohmann::json& message);

}  // namespace palpa::room
