#include "apps/room/pairing.h"

#include <openssl/rand.h>

#include <array>
#include <cstdio>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/utc.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/os/tls/kept_identity.h"
#include "apps/room/messages.h"
#include "apps/runtime/clock.h"

namespace palpa::room {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::days;

constexpr int kVersion = 1;
constexpr char kFacts[] = "room.json", kWatcher[] = "watcher";
/// No browser sees these certificates; who is to be kept out is no longer in the list of rights.
constexpr days kLasts{1825};

std::string hex8() {
  std::array<unsigned char, 4> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
    throw Error("has no random numbers", "the system", "Start the computer again");
  char text[9];
  std::snprintf(text, sizeof text, "%02x%02x%02x%02x", bytes[0], bytes[1], bytes[2], bytes[3]);
  return text;
}

os::Identity authorityIn(const fs::path& folder) {
  os::Identity authority = os::heldIdentity(folder, "authority");
  if (!os::belongTogether(authority))
    throw UsageError("holds no authority", folder.string(),
                     "Make the room again: palpa console pair STATION --broker HOST");
  return authority;
}

std::string rights(const std::string& user, const std::string& station,
                   std::initializer_list<Topic> writes, std::initializer_list<Topic> reads) {
  std::string lines = "\nuser " + user + "\n";
  for (const Topic one : writes) lines += "topic write " + topicOf(station, one) + "\n";
  for (const Topic one : reads) lines += "topic read " + topicOf(station, one) + "\n";
  return lines;
}

/// Mosquitto reads the rest of a line as the value: a path may hold spaces.
std::string brokerSettingsText(const fs::path& folder, int port) {
  const std::string at = folder.string();
  return "# Written by palpa console pair. Start: /usr/sbin/mosquitto -c " + at +
         "/mosquitto.conf\n"
         "# Whose files these are: who starts it as root gives that up\n"
         "user " +
         os::userName() +
         "\n"
         "listener " +
         std::to_string(port) +
         "\n"
         "cafile " +
         at +
         "/authority.pem\n"
         "certfile " +
         at +
         "/own.pem\n"
         "keyfile " +
         at +
         "/own.key\n"
         "tls_version tlsv1.2\n"
         "# Who has a certificate of this room, and bears the name in it\n"
         "require_certificate true\n"
         "use_identity_as_username true\n"
         "use_username_as_clientid true\n"
         "allow_anonymous false\n"
         "acl_file " +
         at +
         "/rights\n"
         "# What stations said last is known again after a restart\n"
         "persistence true\n"
         "persistence_location " +
         at +
         "/broker/\n"
         "autosave_interval 60\n"
         "max_packet_size 65536\n"
         "max_connections 500\n"
         "pid_file " +
         at +
         "/mosquitto.pid\n"
         "log_dest stderr\n"
         "log_type error\n"
         "log_type warning\n"
         "log_type notice\n";
}

}  // namespace

void needStationName(const std::string& name) {
  if (!isStationName(name))
    throw UsageError("is no name of a station", name.substr(0, 64),
                     "Use 1 to 32 letters, digits, - and _");
}

void writePairing(const fs::path& file, const Pairing& p) {
  const json text{{"version", kVersion},
                  {"station", p.station},
                  {"made_utc", p.made_utc},
                  {"broker", p.broker.host},
                  {"port", p.broker.port},
                  {"authority", p.broker.authority},
                  {"certificate", p.broker.identity.certificate},
                  {"key", p.broker.identity.key}};
  writeWhole(file, text.dump(1) + "\n", Lasts::yes, Readers::owner);
}

Pairing readPairing(const fs::path& file, std::chrono::sys_seconds now) {
  const JsonFile json(file, "Have the station paired again: palpa console pair STATION");
  json.needVersion(kVersion);
  if (os::privacyOf(file) == os::Privacy::shared)
    throw UsageError("may be read by others", file.string(), "chmod 600 " + file.string());
  Pairing p;
  p.station = json.text("station");
  if (!isStationName(p.station)) json.refuse("station", "is no name of a station");
  p.made_utc = json.text("made_utc");
  p.broker.host = json.text("broker");
  p.broker.port = json.integer("port", 1, 65535);
  p.broker.authority = json.text("authority");
  p.broker.identity = {json.text("certificate"), json.text("key")};
  if (!os::belongTogether(p.broker.identity)) json.refuse("key", "is not that of the certificate");
  if (os::factsOf(p.broker.identity.certificate, file.string()).until <= now)
    json.refuse("certificate", "is over");
  return p;
}

RoomChange::RoomChange(const fs::path& folder) {
  constexpr std::chrono::seconds kPatience{10};
  if (const std::error_code problem = os::makeFolders(folder))
    failFile("cannot be made", folder, problem, "Or choose another folder with --room");
  if (!runtime::comesTrue(kPatience, [&] {
        lock_ = os::FileLock::exclusive(folder / "changing", os::FileLock::Missing::is_made);
        return lock_ != nullptr;
      }))
    throw Error("cannot be changed", "the room " + folder.string(),
                "Perhaps another palpa console pair is at work: wait for its end. Or the folder "
                "is another user's");
}

Room Room::made(const fs::path& folder, const std::string& host, int port,
                std::chrono::sys_seconds now) {
  Room room(fs::absolute(folder));
  std::error_code none;
  if (fs::exists(room.folder_ / kFacts, none)) room = in(folder);
  const std::string place = os::usualForm(host);
  if (!room.stations_.empty() && (room.host_ != place || room.port_ != port))
    throw UsageError(
        "has stations that know its broker at " + room.host_ + ":" + std::to_string(room.port_),
        "the room " + folder.string(),
        "Leave --broker and --port out; or make another room with --room, and pair "
        "all stations to that");
  room.host_ = place;
  room.port_ = port;
  if (const std::error_code problem = os::makeFolders(room.folder_ / "broker"))
    failFile("cannot be made", room.folder_, problem, "Or choose another folder with --room");
  const os::KeptIdentity own =
      os::keptIdentity(room.folder_,
                       {.name = "Palpa room at " + room.host_.substr(0, 40),
                        .reached_by = {room.host_},
                        .lasts = kLasts},
                       now);
  if (own.is_new) room.stations_.clear();  // nobody knows the new authority
  room.write();
  return room;
}

Room Room::in(const fs::path& folder) {
  Room room(fs::absolute(folder));
  std::error_code none;
  if (!fs::exists(room.folder_ / kFacts, none))
    throw UsageError("is no room's folder", folder.string(),
                     "Make one by pairing the first station: palpa console pair STATION --broker "
                     "HOST");
  const JsonFile json(room.folder_ / kFacts, "Restore the folder from a backup");
  json.needVersion(kVersion);
  room.host_ = json.text("broker");
  room.port_ = json.integer("port", 1, 65535);
  for (const JsonFile& one : json.entries("stations")) {
    const std::string name = one.text("name");
    if (!isStationName(name)) one.refuse("name", "is no name of a station");
    room.stations_[name] = {one.text("user"), one.text("since_utc")};
  }
  return room;
}

void Room::write() const {
  json stations = json::array();
  std::string all = "# Written by palpa console pair\n";
  all += rights(kWatcher, "+", {Topic::heard, Topic::asks},
                {Topic::about, Topic::state, Topic::events, Topic::answers, Topic::heard});
  for (const auto& [name, station] : stations_) {
    stations.push_back({{"name", name}, {"user", station.user}, {"since_utc", station.since_utc}});
    all += rights(station.user, name, {Topic::about, Topic::state, Topic::events, Topic::answers},
                  {Topic::heard, Topic::asks});
  }
  writeWhole(folder_ / "rights", all, Lasts::yes, Readers::owner);
  writeWhole(brokerSettings(), brokerSettingsText(folder_, port_));
  writeWhole(
      folder_ / kFacts,
      json{{"version", kVersion}, {"broker", host_}, {"port", port_}, {"stations", stations}}.dump(
          1) +
          "\n");
}

BrokerAccess Room::access(const os::Identity& identity) const {
  return {host_, port_, os::heldIdentity(folder_, "authority").certificate, identity};
}

Pairing Room::pair(const std::string& station, std::chrono::sys_seconds now,
                   const std::function<void(const Pairing&)>& hand) {
  needStationName(station);
  const std::string user = station + "-" + hex8();
  const os::Identity identity = os::makeIdentity(
      {.name = user, .reached_by = {}, .purpose = os::Purpose::client, .lasts = kLasts},
      authorityIn(folder_), now);
  const auto before = stations_.find(station);
  const std::string since = before == stations_.end() ? isoTime(now) : before->second.since_utc;
  Pairing pairing{station, since, access(identity)};
  if (hand) hand(pairing);
  stations_[station] = {user, since};
  write();
  return pairing;
}

bool Room::forget(const std::string& station) {
  if (stations_.erase(station) == 0) return false;
  write();
  return true;
}

BrokerAccess Room::watcher(std::chrono::sys_seconds now) const {
  const os::Identity authority = authorityIn(folder_);
  os::Identity own = os::heldIdentity(folder_, kWatcher);
  if (!os::belongTogether(own) ||
      !os::isVouchedFor(own.certificate, authority.certificate, now + days(30))) {
    own = os::makeIdentity(
        {.name = kWatcher, .reached_by = {}, .purpose = os::Purpose::client, .lasts = kLasts},
        authority, now);
    os::holdIdentity(folder_, kWatcher, own);
  }
  return access(own);
}

}  // namespace palpa::room
