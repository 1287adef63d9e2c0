#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/room/room_parts.h"
#include "apps/bench/room/room_tally.h"
#include "apps/os/child_process.h"
#include "apps/os/file_access.h"
#include "apps/room/pairing.h"
#include "apps/room/watch.h"

namespace palpa::bench {

struct RoomRigSettings {
  int stations = 20;    ///< with that of the session in real time, which is the last
  double seconds = 20;  ///< of a session in real time
  std::string records;  ///< where the trials go
  std::string trainee;  ///< whose
};

/// A room on this computer, all in one folder that passes: the broker, stations that play recorded
/// sessions or hold one in real time, and who watches. Each station is a process, so is each
/// session. Throws Error.
class RoomRig {
 public:
  explicit RoomRig(const RoomRigSettings& settings);
  ~RoomRig();
  RoomRig(const RoomRig&) = delete;
  RoomRig& operator=(const RoomRig&) = delete;

  /// Broker, watcher and the stations that play, all heard; none that runs already is begun again.
  void gather();
  /// All of it ends, as it is asked to; nothing is lost that was recorded.
  void disperse();
  /// A session in real time that begins now, at its station in the room, or alone.
  void beginSession(std::uint64_t seed, bool in_room);
  /// Lateness of its haptic tick, once it is over.
  std::optional<nlohmann::json> lateness() const;
  /// Stations, the last one's session in real time runs on. `off`: as if the whole computer was
  /// switched off, with the session. They are begun again at once.
  void killStation(int number, bool off);
  void killBroker();
  int stations() const { return settings_.stations; }
  bool holdsRealSession(int number) const { return number + 1 == settings_.stations; }

  /// Without any session: until the watcher has all that was recorded, at most two minutes.
  RoomTally tellTheRest();

 private:
  struct Station {
    std::string name;
    std::filesystem::path home;
    RoomPart part;
    os::ProcessId process;
  };
  void record();
  void startBroker();
  void startStation(Station& station);
  void prepare(Station& station, int number);
  std::vector<os::ProcessId> sessionsOf(const Station& station) const;
  RoomTally tally() const;
  std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }

  const RoomRigSettings settings_;
  const os::TemporaryFolder folder_;
  std::optional<room::Room> room_;
  std::vector<std::filesystem::path> recorded_;
  std::vector<Station> stations_;
  os::ProcessId broker_, alone_;
  std::unique_ptr<room::RoomWatch> watch_;
  int sessions_ = 0;  ///< in real time, so far
  std::filesystem::path result_;
};

}  // namespace palpa::bench
