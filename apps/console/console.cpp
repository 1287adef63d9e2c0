#include "apps/console/console.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

#include "anatomy/base/error.h"
#include "anatomy/base/utc.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/routes.h"
#include "apps/os/file_access.h"
#include "apps/os/real_time.h"
#include "apps/os/signals.h"
#include "apps/os/socket.h"
#include "apps/os/tls/kept_identity.h"
#include "apps/os/tls/tls_line.h"
#include "apps/room/pairing.h"
#include "apps/runtime/clock.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::milliseconds kRound{200};

/// One console a place: two would start two sessions on one station. Released with the process,
/// however it ends.
class OnlyOne {
 public:
  explicit OnlyOne(const fs::path& home) : url_(home / "address") {
    if (runtime::comesTrue(runtime::kKilledLetsGo, [&] { return takes(home / "lock"); })) return;
    std::string url;
    std::getline(std::ifstream(url_), url);
    throw Error("runs already", "a console of this user" + (url.empty() ? "" : " (" + url + ")"),
                "Use that one, or choose another folder with --home");
  }
  ~OnlyOne() {
    std::error_code none;
    fs::remove(url_, none);
  }
  void announce(const std::string& url) { writeWhole(url_, url + "\n", Lasts::no); }

 private:
  bool takes(const fs::path& file) {
    lock_ = os::FileLock::exclusive(file, os::FileLock::Missing::is_made);
    return lock_ != nullptr;
  }
  const fs::path url_;
  std::unique_ptr<os::FileLock> lock_;
};

std::string bracketed(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

bool isAnyAddress(const std::string& address) { return address == "0.0.0.0" || address == "::"; }

/// By which it may be called, beside what a certificate of the centre's own says.
std::vector<std::string> namesOf(const ConsoleSettings& s) {
  std::vector<std::string> names;
  for (const std::string& name : s.names) names.push_back(os::usualForm(name));
  for (const char* own : {"127.0.0.1", "localhost", "::1"}) names.push_back(own);
  if (!isAnyAddress(s.address)) names.push_back(os::usualForm(s.address));
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// What stands between the console and whoever listens in; nothing on this computer alone. A
/// certificate that was renewed is used from within the hour.
class Encryption {
 public:
  explicit Encryption(const ConsoleSettings& s) : settings_(s) {
    if (!s.tls && s.certificate.empty() && isLoopback(s.address)) return;
    const os::KeptIdentity own = identity();
    server_ = std::make_unique<os::TlsServer>(own.identity);
    facts_ = os::factsOf(own.identity.certificate, "the certificate");
    authority_ = own.authority;
    authority_is_new_ = own.is_new;
  }
  const os::TlsServer* server() const { return server_.get(); }
  const char* scheme() const { return server_ ? "https" : "http"; }

  /// Under which the console answers, with the port where a browser says it.
  std::vector<std::string> hosts(int port) const {
    std::vector<std::string> names = namesOf(settings_), hosts;
    for (const std::string& name : facts_.reached_by)
      if (name.find('*') == std::string::npos) names.push_back(name);
    for (const std::string& name : names) {
      hosts.push_back(bracketed(name) + ":" + std::to_string(port));
      if (port == (server_ ? 443 : 80)) hosts.push_back(bracketed(name));
    }
    return hosts;
  }
  /// What is said when it can be used: by a name that the certificate has.
  OpenedConsole opened(int port) const {
    std::string host =
        isAnyAddress(settings_.address) ? "127.0.0.1" : os::usualForm(settings_.address);
    const std::vector<std::string>& known = facts_.reached_by;
    if (!known.empty() && std::find(known.begin(), known.end(), host) == known.end() &&
        known.front().find('*') == std::string::npos)
      host = known.front();
    return {scheme() + std::string("://") + bracketed(host) + ":" + std::to_string(port) + "/",
            facts_.fingerprint, authority_,
            authority_.empty() ? "" : os::factsOf(*readWhole(authority_), "").fingerprint,
            authority_is_new_};
  }
  /// Now and then. What goes wrong is said; the certificate in use stays.
  void look() {
    if (!server_ || runtime::ServingClock::now() < next_) return;
    next_ = runtime::ServingClock::now() + kLook;
    try {
      const os::KeptIdentity own = identity();
      const os::CertificateFacts facts = os::factsOf(own.identity.certificate, "the certificate");
      if (facts.fingerprint != facts_.fingerprint) server_->use(own.identity);
      facts_ = facts;
    } catch (const Error& e) {
      std::fprintf(stderr, "The certificate could not be renewed: %s\n", e.what());
    }
  }

 private:
  static constexpr std::chrono::hours kLook{1};
  os::KeptIdentity identity() const {
    constexpr std::size_t kLongest = 45;  // of a name to which more words are added
    const ConsoleSettings& s = settings_;
    const auto now = utcSecondsOf(runtime::utcNow());
    if (!s.certificate.empty()) return {os::identityIn(s.certificate, s.key, now), {}};
    const std::string at = !s.names.empty()          ? s.names.front()
                           : isAnyAddress(s.address) ? "this computer"
                                                     : s.address;
    return os::keptIdentity(
        s.place.home / "tls",
        {.name = ("Palpa console at " + at).substr(0, kLongest), .reached_by = namesOf(s)}, now);
  }

  const ConsoleSettings& settings_;
  std::unique_ptr<os::TlsServer> server_;
  os::CertificateFacts facts_;
  std::filesystem::path authority_;
  bool authority_is_new_ = false;
  runtime::ServingClock::time_point next_ = runtime::ServingClock::now() + kLook;
};

/// Where it listens: the port asked for, or any free one.
int portOf(WebServer& server, const ConsoleSettings& s) {
  if (s.port != 0 && runtime::comesTrue(runtime::kKilledLetsGo,
                                        [&] { return server.bind_to_port(s.address, s.port); }))
    return s.port;
  if (const int port = s.port == 0 ? server.bind_to_any_port(s.address) : 0; port > 0) return port;
  throw Error("cannot be opened for listening",
              s.address + (s.port ? ", port " + std::to_string(s.port) : ""),
              "Perhaps another program uses it: choose another with --port");
}

/// The server's own thread, ended in any case: an error on the way, as of a full disk, is to be
/// said.
class Serving {
 public:
  explicit Serving(WebServer& server)
      : server_(server), thread_(os::startThread([&server] { server.serve(); })) {}
  ~Serving() {
    server_.end();
    thread_.join();
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

 private:
  WebServer& server_;
  std::thread thread_;
};

/// By a name that others reach it by: of a station whose address is any, one must be given.
std::string urlForRoom(const ConsoleSettings& s, const OpenedConsole& opened,
                       const std::string& broker) {
  if (isLoopback(s.address) && !isLoopback(broker)) return "";  // nobody there reaches it
  if (!isAnyAddress(s.address)) return opened.url;
  if (s.names.empty())
    throw UsageError("does not say how the room reaches this station", "--listen " + s.address,
                     "Give its own address, or its name with --name");
  const std::string port = opened.url.substr(opened.url.rfind(':'));
  return "https://" + bracketed(os::usualForm(s.names.front())) + port;
}

void joinRoom(const ConsoleSettings& s, const OpenedConsole& opened, std::chrono::sys_seconds now,
              Console* console) {
  const std::string authority =
      opened.authority.empty() ? "" : readWhole(opened.authority).value_or("");
  const room::Pairing pairing = room::readPairing(s.room, now);
  const std::string url = urlForRoom(s, opened, pairing.broker.host);
  console->joined = std::make_unique<RoomStation>(*console, pairing, url, authority);
}

/// Watches a room, or joins one.
void enterRoom(const ConsoleSettings& s, const OpenedConsole& opened, Console* console) {
  if (s.room.empty()) return;
  const auto now = utcSecondsOf(runtime::utcNow());
  if (fs::is_directory(s.room)) {
    console->room = s.room;
    console->watch = std::make_unique<room::RoomWatch>(room::Room::in(s.room).watcher(now),
                                                       s.place.home / "room");
    return;
  }
  try {
    joinRoom(s, opened, now, console);
  } catch (const Error& e) {  // a station is whole without a room
    console->room_trouble = e.what();
    std::fprintf(stderr, "Not in the room: %s\n", e.what());
  }
}

/// Whom others can reach they find, and who watches a room looks who is there.
void meetOthersNearby(const ConsoleSettings& s, int port, Console* console) {
  room::Nearby::Wish wish;
  wish.looks = console->watch != nullptr;
  if (!isLoopback(s.address))
    wish.announces = {.name = "",
                      .host = "",
                      .station = console->joined ? console->joined->name() : "",
                      .version = s.place.version,
                      .port = port,
                      .watches = wish.looks};
  if (wish.announces || wish.looks) console->nearby = std::make_unique<room::Nearby>(wish);
}

void prepare(const ConsolePlace& place) {
  if (const std::error_code problem = os::makeFolders(place.home))
    failFile("cannot be used", place.home, problem, "Or choose another folder with --home");
}

}  // namespace

bool isLoopback(const std::string& address) {
  return address == "localhost" || address == "::1" || os::isLoopbackAddress(address);
}

void serveConsole(const ConsoleSettings& s,
                  const std::function<void(const OpenedConsole&)>& ready) {
  if (!isLoopback(s.address) && s.token.empty())
    throw UsageError(
        "needs a token", "--listen " + s.address,
        "Others can reach this address: give a file that holds a token with --token-file");
  os::shareMemoryPools();
  prepare(s.place);
  OnlyOne only(s.place.home);
  if (!s.station.empty()) chooseStation(s.place, s.station);
  const os::InterruptNote interrupt(os::InterruptNote::Again::noted);
  Refusals refusals(s.place.home / "refused.log");
  Guard guard(s.token);
  Encryption encryption(s);
  WebServer server(guard, refusals, encryption.server());
  const int port = portOf(server, s);
  guard.answerTo(encryption.hosts(port), encryption.scheme());
  ConsolePlace place = s.place;
  place.reached = !isLoopback(s.address) || !s.names.empty();
  Console console(place, guard, s.tone);
  addPages(server, console);
  addStationRoutes(server, console);
  addPeopleRoutes(server, console);
  addSessionRoutes(server, console);
  addLiveRoutes(server, console);
  addRatingRoutes(server, console);
  addReplayRoutes(server, console);
  addFilmRoutes(server, console);
  addRoomRoutes(server, console);
  addOwnRoutes(server, console);
  addLearningRoutes(server, console);
  console.learning = openLearningDesk(console);
  checkHealth(console);
  const OpenedConsole opened = encryption.opened(port);
  enterRoom(s, opened, &console);
  meetOthersNearby(s, port, &console);
  const Serving serving(server);
  only.announce(opened.url);
  ready(opened);
  while (!interrupt.noted()) {
    runtime::rest(kRound);
    console.sessions.look();
    server.noteTurnedAway();
    encryption.look();
  }
}

}  // namespace palpa::console
