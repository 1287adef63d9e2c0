#pragma once

#include <atomic>
#include <set>
#include <string>
#include <thread>

#include "apps/console/session_link.h"
#include "apps/room/station_line.h"

namespace palpa::console {

struct Console;

/// This station's part in a room: how its session stands, what its sessions record, what the room
/// asks for. Events come from the session that runs as it tells them, of those that are over from
/// their records. On a thread of its own, which gives way to all others.
class RoomStation {
 public:
  /// `url`, `authority` (PEM): where this console's picture is had, and who vouches for it.
  RoomStation(Console& console, const room::Pairing& pairing, const std::string& url,
              const std::string& authority);
  ~RoomStation();
  RoomStation(const RoomStation&) = delete;
  RoomStation& operator=(const RoomStation&) = delete;

  const std::string& name() const { return pairing_.station; }
  room::BrokerLine::State line() const { return line_.state(); }
  bool isPictureKey(const std::string& key) const;

 private:
  void run();
  void follow();
  void followState();
  void followEvents();
  bool tell(const nlohmann::json& entry);
  void tellOldest();
  bool readNext();
  void readOf(const std::string& id);
  void beginAgain();
  room::Answer handle(const room::Ask& ask);

  Console& console_;
  const room::Pairing pairing_;
  const std::string picture_key_;
  room::StationState state_;

  // Of the session that runs.
  std::string on_;
  std::shared_ptr<SessionLink> link_;
  std::size_t state_from_ = 0, events_from_ = 0;
  std::string record_;
  std::int64_t next_ = 0;  ///< number of its next event
  bool lost_ = false;      ///< some of its entries are no longer kept: its record tells them

  // Of those that are over: what the oldest of them has to tell.
  std::string over_;
  std::vector<room::Happening> recorded_;
  std::size_t recorded_from_ = 0;
  std::set<std::string> done_;  ///< told whole, or not to be read
  int beginnings_ = 0;          ///< of the line, as last seen
  runtime::ServingClock::time_point next_look_{};

  room::StationLine line_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace palpa::console
