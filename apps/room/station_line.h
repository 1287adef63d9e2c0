#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "apps/room/messages.h"
#include "apps/room/pairing.h"
#include "apps/runtime/clock.h"

namespace palpa::room {

/// A station's end of the room: says how it stands, tells what its sessions record, does what it is
/// asked. An event counts as told when the watcher says that it has it, not when the broker took
/// it: a broker that dies loses nothing. Until then it is told again. Any thread.
class StationLine {
 public:
  /// `handles`: does what is asked, one after the other, on a thread of its own; a stop at once, on
  /// the line's thread, whatever else is being done or waits.
  StationLine(const Pairing& pairing, const StationFacts& facts,
              std::function<Answer(const Ask&)> handles);
  ~StationLine();
  StationLine(const StationLine&) = delete;
  StationLine& operator=(const StationLine&) = delete;

  /// Said when it is another than before (but for time that passes), and every 5 s. `state.utc` is
  /// the caller's.
  void show(StationState state);
  /// Whether the watcher wants a session's events; nothing: he has not said what he has.
  std::optional<bool> wants(const std::string& session) const;
  /// Of a record, in its order. What was told or heard before is passed over. False: too much is
  /// under way, try again later.
  bool tell(const Happening& happening);
  /// Another number than before: the watcher has less than he had; all is to be told from its
  /// beginning.
  int beginnings() const;
  /// Up to which number the watcher has it; -1: nothing.
  std::int64_t heardOf(const std::string& session, const std::string& record) const;
  /// Now and then: what was not heard in time is told again.
  void look();
  BrokerLine::State state() const { return line_.state(); }

 private:
  using Time = runtime::ServingClock::time_point;
  std::vector<Said> greeting();
  void hears(const Said& said);
  void hearsOf(const Heard& heard);
  void take(const Ask& ask);
  void handle(const Ask& ask);
  void handleAll();
  void tellAgain();
  bool missesWhatIsNotUnderWay() const;
  Said said(Topic topic, const nlohmann::json& message, bool retained) const;

  const std::string station_;
  const StationFacts facts_;
  const std::function<Answer(const Ask&)> handles_;
  mutable std::mutex mutex_;
  StationState shown_;
  Time shown_at_{};
  std::optional<Heard> heard_;
  std::deque<Happening> under_way_;  ///< told and not heard
  struct Told {
    std::string session;
    std::int64_t number = -1;
  };
  std::map<std::string, Told> told_;  ///< of each record: the newest
  int beginnings_ = 0;
  Time moved_{};  ///< something was heard, or told again
  std::chrono::seconds patience_;
  std::deque<std::string> asked_;  ///< newest ids: a broker may say a thing twice
  struct Waiting {
    Ask ask;
    Time came;
  };
  std::deque<Waiting> asks_;  ///< to be done, but for stops
  std::condition_variable came_;
  bool ending_ = false;
  BrokerLine line_;  ///< its thread uses what is above
  std::thread handler_;
};

}  // namespace palpa::room
