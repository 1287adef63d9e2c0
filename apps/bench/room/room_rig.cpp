#include "apps/bench/room/room_rig.h"

#include <algorithm>
#include <cstdlib>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/utc.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/local_socket.h"
#include "apps/os/tcp_socket.h"
#include "apps/runtime/clock.h"

namespace palpa::bench {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

constexpr char kBroker[] = "/usr/sbin/mosquitto";
constexpr int kRecordings = 4;
constexpr seconds kPatience{120};

void need(bool done, const std::string& what, const std::string& log) {
  if (!done) throw Error("did not come about", what, "Look into " + log);
}

void endAll(const std::vector<os::ProcessId>& processes) {
  for (const os::ProcessId& one : processes) os::askToEnd(one);
  runtime::comesTrue(kPatience,
                     [&] { return std::none_of(processes.begin(), processes.end(), os::runs); });
  for (const os::ProcessId& one : processes) os::endAtOnce(one);
}

std::chrono::sys_seconds now() { return utcSecondsOf(runtime::utcNow()); }

}  // namespace

RoomRig::RoomRig(const RoomRigSettings& settings)
    : settings_(settings), folder_("palpa-bench-room-") {
  if (!folder_.made())
    throw Error("cannot be made", folder_.path().string(), "Free space there, or set TMPDIR");
  std::error_code none;
  if (!fs::exists(kBroker, none))
    throw Error("is not installed", "mosquitto, the room's broker", "apt install mosquitto");
  // What its processes remember passes with the folder.
  setenv("XDG_STATE_HOME", at("state").c_str(), 1);
  setenv("XDG_DATA_HOME", at("data").c_str(), 1);
  record();
  room_ = room::Room::made(at("room"), "localhost", os::TcpListener("127.0.0.1", 0).port(), now());
  for (int i = 0; i < settings_.stations; ++i) prepare(stations_.emplace_back(), i);
}

RoomRig::~RoomRig() {
  try {
    disperse();
  } catch (const std::exception&) {  // what is left ends with the folder
  }
}

/// Sessions of the simulated expert, in virtual time.
void RoomRig::record() {
  for (int i = 0; i < std::min(kRecordings, settings_.stations - 1); ++i) {
    const fs::path folder = at("recorded-" + std::to_string(i));
    const os::Spent spent = os::runToEnd(
        {"subclavian", "--operator", "expert", "--fast", "--no-views", "--tracking", "model",
         "--trials", "3", "--seed", std::to_string(40 + i), "--quiet", "--out", folder.string()},
        at("recorded.log"));
    if (spent.exit_code != 0)
      throw Error("could not be recorded", "a session to be played",
                  readWhole(at("recorded.log")).value_or(""));
    recorded_.push_back(folder / "session.palpa");
  }
}

void RoomRig::prepare(Station& station, int number) {
  station.name = "station" + std::to_string(number + 1);
  station.home = at(station.name);
  const fs::path pairing = at(station.name + ".palpa-pairing");
  // Clocks to the second: what begins now is not of before.
  writePairing(pairing, room_->pair(station.name, now() - std::chrono::hours(1)));
  station.part = {.home = station.home,
                  .pairing = pairing,
                  .sockets = os::socketFolder(),
                  .holds = {},
                  .held = {},
                  .recorded = {},
                  .result = {},
                  .seconds = settings_.seconds,
                  .seed = 1,
                  .trainee = settings_.trainee,
                  .records = settings_.records};
  if (holdsRealSession(number)) return;
  const fs::path play = at(station.name + "-plays");
  RoomPart part = station.part;
  part.recorded = recorded_[static_cast<std::size_t>(number) % recorded_.size()];
  write(play, part);
  station.part.holds = wordsOf("play", play);
}

void RoomRig::startBroker() {
  broker_ = os::startInstalled(kBroker, {"-c", room_->brokerSettings().string()}, at("broker.log"));
  const auto port = static_cast<std::uint16_t>(room_->port());
  need(runtime::comesTrue(kPatience,
                          [&] {
                            return os::TcpSocket::connecting("127.0.0.1", port).connected(100) ==
                                   os::TcpSocket::Progress::done;
                          }),
       "the room's broker", at("broker.log"));
}

void RoomRig::startStation(Station& station) {
  const fs::path file = at(station.name + "-is");
  write(file, station.part);
  station.process = os::start(wordsOf("station", file), at(station.name + ".log"), false);
}

void RoomRig::gather() {
  if (!os::runs(broker_)) startBroker();
  if (!watch_) watch_ = std::make_unique<room::RoomWatch>(room_->watcher(now()), at("watch"));
  for (Station& one : stations_)
    if (!one.part.holds.empty() && !os::runs(one.process)) startStation(one);
  for (std::size_t i = 0; i + 1 < stations_.size(); ++i)
    need(runtime::comesTrue(kPatience,
                            [&] {
                              const auto all = watch_->stations();
                              const auto found = all.find(stations_[i].name);
                              return found != all.end() && !found->second.state.session.empty() &&
                                     found->second.state.state != "starting";
                            }),
         stations_[i].name + " in the room", at(stations_[i].name + ".log"));
}

/// Those that run, or may still.
std::vector<os::ProcessId> RoomRig::sessionsOf(const Station& station) const {
  std::vector<os::ProcessId> all;
  std::error_code none;
  for (const auto& session : fs::directory_iterator(station.home / "sessions", none)) {
    const nlohmann::json facts =
        parsedOrDiscarded(readWhole(session.path() / "console.json").value_or(""));
    if (!facts.is_object() || !facts.contains("pid")) continue;
    const os::ProcessId process{facts["pid"], facts["began"]};
    if (os::runs(process)) all.push_back(process);
  }
  return all;
}

void RoomRig::disperse() {
  std::vector<os::ProcessId> stations, sessions;
  for (const Station& one : stations_) stations.push_back(one.process);
  endAll(stations);  // first, or they begin anew what ends
  for (const Station& one : stations_)
    for (const os::ProcessId& session : sessionsOf(one)) sessions.push_back(session);
  endAll(sessions);
  endAll({alone_, broker_});
  watch_.reset();
}

void RoomRig::beginSession(std::uint64_t seed, bool in_room) {
  const std::string name = "session-" + std::to_string(++sessions_);
  RoomPart part = stations_.back().part;
  part.holds.clear();
  part.seed = seed;
  part.result = result_ = at(name + ".json");
  write(at(name), part);
  if (!in_room) {
    if (const std::error_code problem = os::makeFolders(at(name + "-out")))
      failFile("cannot be made", at(name + "-out"), problem);
    std::vector<std::string> words = wordsOf("session", at(name));
    words.insert(words.end(), {"--out", at(name + "-out").string()});
    alone_ = os::start(words, at(name + ".log"), false);
    return;
  }
  Station& station = stations_.back();
  endAll({station.process});
  station.part.holds = wordsOf("session", at(name));
  station.part.held = at(name + "-held");
  startStation(station);
}

std::optional<nlohmann::json> RoomRig::lateness() const {
  const auto text = readWhole(result_);
  if (!text) return std::nullopt;
  nlohmann::json result = parsedOrDiscarded(*text);
  if (result.is_discarded()) return std::nullopt;
  return result;
}

void RoomRig::killStation(int number, bool off) {
  Station& station = stations_[static_cast<std::size_t>(number)];
  os::endAtOnce(station.process);
  if (off)
    for (const os::ProcessId& session : sessionsOf(station)) os::endAtOnce(session);
  runtime::comesTrue(kPatience, [&] { return !os::runs(station.process); });
  startStation(station);
}

void RoomRig::killBroker() {
  os::endAtOnce(broker_);
  runtime::comesTrue(kPatience, [&] { return !os::runs(broker_); });
  startBroker();
}

RoomTally RoomRig::tally() const {
  RoomTally all;
  for (const Station& one : stations_)
    add(recordedIn(one.home, &all.cut_off), arrivedFrom(one.name, at("watch")), &all);
  return all;
}

RoomTally RoomRig::tellTheRest() {
  disperse();
  startBroker();
  watch_ = std::make_unique<room::RoomWatch>(room_->watcher(now()), at("watch"));
  for (Station& one : stations_) {
    one.part.holds.clear();
    startStation(one);
  }
  RoomTally all;
  runtime::comesTrue(kPatience, [&] {
    all = tally();
    if (all.missing > 0) runtime::rest(seconds(1));
    return all.missing == 0;
  });
  disperse();
  return tally();
}

}  // namespace palpa::bench
