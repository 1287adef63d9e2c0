#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "apps/os/file_access.h"
#include "apps/room/broker_line.h"

namespace palpa::room {

/// What a station is given, once, in a file: who has it speaks as this station.
struct Pairing {
  std::string station;
  std::string made_utc;  ///< the first time; events of sessions begun before stay with the station
  BrokerAccess broker;
};
/// Throws UsageError for what is none.
void needStationName(const std::string& name);
/// For its owner alone. Throws Error.
void writePairing(const std::filesystem::path& file, const Pairing& pairing);
/// Throws UsageError where it can be read by others, is damaged, of a newer program, or over at
/// `now`.
Pairing readPairing(const std::filesystem::path& file, std::chrono::sys_seconds now);

/// Held while a room's folder is changed, or two who pair at once would each write down a room
/// without the other's station. Waits for another one, ten seconds at most; then throws Error, as
/// where the folder cannot be written.
class RoomChange {
 public:
  explicit RoomChange(const std::filesystem::path& folder);

 private:
  std::unique_ptr<os::FileLock> lock_;
};

/// The folder of a room: an authority of its own, the certificates that it has given, and what its
/// broker (mosquitto) is started with: `mosquitto -c FOLDER/mosquitto.conf`. The broker lets in who
/// has a certificate of the room; a station may speak in its own topics only, with its newest
/// certificate only.
class Room {
 public:
  /// `host`, `port`: where stations reach the broker. One that is there keeps what it has. Throws
  /// Error where the folder cannot be written, UsageError for a host that no certificate can hold,
  /// and where stations are paired to another place.
  static Room made(const std::filesystem::path& folder, const std::string& host, int port,
                   std::chrono::sys_seconds now);
  /// One that is there. Throws UsageError where none is, or where it is damaged.
  static Room in(const std::filesystem::path& folder);

  /// Gives a station a certificate; one that it had before is of no use from then on, once the
  /// broker has read its files again (SIGHUP). `hand`, where given, is called with what the station
  /// gets before its old rights go. Throws UsageError for a name that is none.
  Pairing pair(const std::string& station, std::chrono::sys_seconds now,
               const std::function<void(const Pairing&)>& hand = {});
  /// False: it is not paired.
  bool forget(const std::string& station);
  /// For who watches the room; made anew a month before it is over.
  BrokerAccess watcher(std::chrono::sys_seconds now) const;

  const std::string& host() const { return host_; }
  int port() const { return port_; }
  struct Station {
    std::string user;       ///< its name at the broker
    std::string since_utc;  ///< when it was paired first
    bool operator==(const Station&) const = default;
  };
  const std::map<std::string, Station>& stations() const { return stations_; }
  std::filesystem::path brokerSettings() const { return folder_ / "mosquitto.conf"; }

 private:
  explicit Room(std::filesystem::path folder) : folder_(std::move(folder)) {}
  void write() const;
  BrokerAccess access(const os::Identity& identity) const;

  std::filesystem::path folder_;
  std::string host_;
  int port_ = 0;
  std::map<std::string, Station> stations_;
};

}  // namespace palpa::room
