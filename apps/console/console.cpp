#include "apps/console/console.h"

#include <algorithm>
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

/// By which it may be called.
std::vector<std::string> namesOf(const ConsoleSettings& s) {
  std::vector<std::string> names = s.names;
  for (const char* own : {"127.0.0.1", "localhost", "::1"}) names.push_back(own);
  if (!isAnyAddress(s.address)) names.push_back(s.address);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<std::string> hostsOf(const ConsoleSettings& s, int port) {
  std::vector<std::string> hosts;
  for (const std::string& name : namesOf(s))
    hosts.push_back(bracketed(name) + ":" + std::to_string(port));
  return hosts;
}

/// What stands between the console and whoever listens in; nothing on this computer alone.
struct Encryption {
  std::unique_ptr<os::TlsServer> tls;
  OpenedConsole opened;
};

os::KeptIdentity identityOf(const ConsoleSettings& s) {
  constexpr std::size_t kLongest = 45;  // of a name to which more words are added
  const auto now = utcSecondsOf(runtime::utcNow());
  if (!s.certificate.empty()) return {os::identityIn(s.certificate, s.key, now), {}};
  const std::string at = !s.names.empty()          ? s.names.front()
                         : isAnyAddress(s.address) ? "this computer"
                                                   : s.address;
  return os::keptIdentity(
      s.place.home / "tls",
      {.name = ("Palpa console at " + at).substr(0, kLongest), .reached_by = namesOf(s)}, now);
}

Encryption encryptionOf(const ConsoleSettings& s) {
  if (!s.tls && s.certificate.empty() && isLoopback(s.address)) return {};
  const os::KeptIdentity own = identityOf(s);
  return {
      std::make_unique<os::TlsServer>(own.identity),
      {"", os::factsOf(own.identity.certificate, "the certificate").fingerprint, own.authority}};
}

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

void addPages(WebServer& server, const Console& c) {
  server.Get("/", [&c](const httplib::Request&, httplib::Response& r) {
    sendFile(r, c.place.pages / "index.html", mediaTypeOf(".html"));
  });
  server.Get(R"(/static/([a-z0-9_-]{1,40}\.(?:js|css|svg)))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               sendFile(r, c.place.pages / q.matches[1].str(), mediaTypeOf(q.matches[1]));
             });
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
  Encryption encryption = encryptionOf(s);
  WebServer server(guard, refusals, encryption.tls.get());
  const int port = portOf(server, s);
  const std::string scheme = encryption.tls ? "https" : "http";
  guard.answerTo(hostsOf(s, port), scheme);
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
  addRoomRoutes(server, console);
  addOwnRoutes(server, console);
  checkHealth(console);
  const Serving serving(server);
  encryption.opened.url = scheme + "://" +
                          bracketed(s.address == "0.0.0.0" ? "127.0.0.1" : s.address) + ":" +
                          std::to_string(port) + "/";
  only.announce(encryption.opened.url);
  ready(encryption.opened);
  while (!interrupt.noted()) {
    runtime::rest(kRound);
    console.sessions.look();
    server.noteTurnedAway();
  }
}

}  // namespace palpa::console
