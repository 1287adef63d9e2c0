#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/room/broker_line.h"
#include "apps/room/messages.h"
#include "apps/runtime/clock.h"

namespace palpa::room {

/// What came from a station, and when.
struct Kept {
  std::string utc;  ///< when it came
  Happening happening;
};

/// Who watches a room: how its stations stand, and every event that their sessions record, once, in
/// order. Events are written to a file before they count as heard, so that a console that is killed
/// neither loses nor doubles one; what a power cut takes from the file is told anew. The file is
/// kept within 16 MB, the oldest go. Any thread.
class RoomWatch {
 public:
  /// `folder`: of its own. Throws Error where it cannot be written.
  RoomWatch(BrokerAccess access, std::filesystem::path folder);
  ~RoomWatch() = default;
  RoomWatch(const RoomWatch&) = delete;
  RoomWatch& operator=(const RoomWatch&) = delete;

  struct Station {
    std::optional<StationFacts> about;
    StationState state;       ///< gone, unless it has said something within the last 15 s
    std::int64_t events = 0;  ///< that came since this console began
    runtime::ServingClock::time_point heard_at{};  ///< live, not what a broker had kept
  };
  std::map<std::string, Station> stations() const;
  /// The newest of a station, the newest last; at most 200.
  std::vector<Kept> happenings(const std::string& station) const;
  /// Nothing: no answer came within `patience`, or the broker is not there. It is not done later.
  std::optional<Answer> ask(const std::string& station, const Ask& ask,
                            std::chrono::seconds patience);
  BrokerLine::State broker() const { return line_.state(); }
  /// Why events cannot be kept; empty: they are.
  std::string trouble() const;

 private:
  struct Known : Station {
    Heard heard;
    std::deque<Kept> newest;
  };
  void read(const std::filesystem::path& file);
  void hears(const Said& said);
  void take(const std::string& station, const Happening& happening);
  bool keep(const std::string& line);
  void turnPage();
  void endLine() const;
  void note(Known* known, const Kept& kept);
  std::vector<Said> greeting();

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::condition_variable answered_;
  std::map<std::string, Known> stations_;
  std::map<std::string, std::optional<Answer>> waited_for_;
  std::string since_;  ///< when the line stood anew, as a number that no other time has
  std::string trouble_;
  BrokerLine line_;  ///< last: its thread uses the rest
};

}  // namespace palpa::room
