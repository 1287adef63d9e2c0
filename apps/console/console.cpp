#include "apps/console/console.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <thread>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/routes.h"
#include "apps/os/local_socket.h"
#include "apps/runtime/clock.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::milliseconds kRound{200};
std::atomic<bool> ended{false};  // a signal may come on any thread
static_assert(std::atomic<bool>::is_always_lock_free);

void note(int) { ended.store(true); }

/// One console a place: two would start two sessions on one station. Released with the process,
/// however it ends.
class OnlyOne {
 public:
  explicit OnlyOne(const fs::path& home) : url_(home / "address") {
    descriptor_ = ::open((home / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    if (descriptor_ >= 0) ::close(descriptor_);
    std::string url;
    std::getline(std::ifstream(url_), url);
    throw Error("runs already", "a console of this user" + (url.empty() ? "" : " (" + url + ")"),
                "Use that one, or give another place with --home");
  }
  ~OnlyOne() {
    std::error_code none;
    fs::remove(url_, none);
    ::close(descriptor_);
  }
  void tell(const std::string& url) { writeWhole(url_, url + "\n"); }

 private:
  const fs::path url_;
  int descriptor_ = -1;
};

std::string bracketed(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

std::vector<std::string> hostsOf(const ConsoleSettings& s, int port) {
  std::vector<std::string> names = s.names, hosts;
  for (const char* own : {"127.0.0.1", "localhost", "::1"}) names.push_back(own);
  if (s.address != "0.0.0.0" && s.address != "::") names.push_back(s.address);
  for (const std::string& name : names)
    hosts.push_back(bracketed(name) + ":" + std::to_string(port));
  return hosts;
}

void addPages(WebServer& server, const Console& c) {
  server.Get("/", [&c](const httplib::Request&, httplib::Response& r) {
    sendFile(r, c.place.pages / "index.html", mediaTypeOf(".html"));
  });
  server.Get(R"(/static/([a-z0-9_-]{1,40}\.(?:js|css|svg)))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               sendFile(r, c.place.pages / q.matches[1].str(), mediaTypeOf(q.matches[1]));
             });
}

void prepare(const Place& place) {
  std::error_code none;
  fs::create_directories(place.home, none);
  fs::permissions(place.home, fs::perms::owner_all, none);
  if (none)
    throw Error("cannot be used (" + none.message() + ")", place.home.string(),
                "Give another place with --home");
}

struct Signals {
  struct sigaction old_int {
  }, old_term{};
  Signals() {
    ended.store(false);
    struct sigaction action {};
    action.sa_handler = note;
    sigaction(SIGINT, &action, &old_int);
    sigaction(SIGTERM, &action, &old_term);
  }
  ~Signals() {
    sigaction(SIGINT, &old_int, nullptr);
    sigaction(SIGTERM, &old_term, nullptr);
  }
};

}  // namespace

bool isLoopback(const std::string& address) {
  in_addr v4{};
  return address == "localhost" || address == "::1" ||
         (::inet_pton(AF_INET, address.c_str(), &v4) == 1 &&
          ntohl(v4.s_addr) >> 24 == 127);  // a name that begins with 127. may be anybody's
}

void serveConsole(const ConsoleSettings& s, const std::function<void(const std::string&)>& ready) {
  if (!isLoopback(s.address) && s.token.empty())
    throw UsageError(
        "needs a token", "--listen " + s.address,
        "Others can reach this address: give a file that holds a token with --token-file");
  prepare(s.place);
  OnlyOne only(s.place.home);
  if (!s.station.empty()) chooseStation(s.place, s.station);
  const Signals signals;
  Refusals refusals(s.place.home / "refused.log");
  Guard guard(s.token);
  WebServer server(guard, refusals);
  const int port = s.port == 0                              ? server.bind_to_any_port(s.address)
                   : server.bind_to_port(s.address, s.port) ? s.port
                                                            : -1;
  if (port <= 0)
    throw Error("cannot be listened at",
                s.address + (s.port ? ", port " + std::to_string(s.port) : ""),
                "Another program uses it, perhaps: choose another with --port");
  server.widen();
  guard.answerTo(hostsOf(s, port));
  Console console(s.place, guard, s.tone);
  addPages(server, console);
  addStationRoutes(server, console);
  addPeopleRoutes(server, console);
  addSessionRoutes(server, console);
  addLiveRoutes(server, console);
  addReplayRoutes(server, console);
  checkHealth(console);
  std::thread serving([&] {
    os::giveWay();
    server.listen_after_bind();
  });
  const std::string url = "http://" + bracketed(s.address == "0.0.0.0" ? "127.0.0.1" : s.address) +
                          ":" + std::to_string(port) + "/";
  only.tell(url);
  ready(url);
  while (!ended.load()) {
    runtime::rest(kRound);
    console.sessions.look();
  }
  server.end();
  serving.join();
}

}  // namespace palpa::console
