#pragma once

// The console whole, in this process: what its threads share is under the sanitizers; sessions and
// commands are played.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "anatomy/base/error.h"
#include "apps/console/console.h"
#include "apps/console/stations.h"
#include "apps/console/web/guard.h"
#include "apps/console/web/httplib_server.h"
#include "apps/console/web/web_server.h"
#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"
#include "apps/trial/trial_status.h"
#include "tests/support/damage.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/short_folder.h"

/// A console that serves in this process, and what is asked of it.
namespace palpa::console {

using nlohmann::json;
using namespace std::chrono_literals;

template <class Seen>
bool inTime(Seen seen) {
  return runtime::comesTrue(60s, seen);
}

class Served {
 public:
  /// `room`: a room's folder, or a station's pairing file.
  Served(const std::filesystem::path& home, const std::string& sockets,
         const std::string& token = "", const std::filesystem::path& room = {}) {
    settings_.room = room;
    settings_.tone = [](const runtime::Event&) { return "neutral"; };
    settings_.token = token;
    if (!token.empty()) settings_.names = {"station.test"};  // others come to it by that
    settings_.place.home = home;
    settings_.place.pages = std::filesystem::path(PALPA_SOURCE_DIR) / "assets/console";
    settings_.place.records = (home.parent_path() / "records.sqlite").string();
    settings_.place.sockets = sockets;
    settings_.place.version = "test";
    settings_.place.display = true;  // a person may perform; none does here
    thread_ = std::thread([this] {
      try {
        serveConsole(settings_, [this](const OpenedConsole& opened) { say(opened.url); });
      } catch (const std::exception& e) {
        say(std::string("! ") + e.what());
      }
    });
    inTime([this] { return !url().empty(); });
  }
  ~Served() { end(); }
  void end() {
    if (!thread_.joinable()) return;
    if (url().rfind("http", 0) == 0) ::kill(::getpid(), SIGTERM);
    thread_.join();
  }
  std::string url() {
    const std::lock_guard lock(mutex_);
    return url_;
  }
  httplib::Client client() {
    httplib::Client one(url().substr(0, url().size() - 1));
    one.set_read_timeout(60);
    return one;
  }
  json get(const std::string& path) {
    const auto answer = client().Get(path);
    return answer ? json::parse(answer->body, nullptr, false) : json();
  }
  int post(const std::string& path, const json& body, json* told = nullptr) {
    if (key_.empty()) key_ = get("/api/me").value("page_key", "");
    const auto answer =
        client().Post(path, {{"X-Palpa-Page", key_}, {"X-Palpa-Write", randomKey()}}, body.dump(),
                      "application/json");
    if (answer && told) *told = json::parse(answer->body, nullptr, false);
    return answer ? answer->status : 0;
  }
  /// Events from after `last`, until `count` have come or the stream has ended.
  std::vector<std::pair<std::size_t, json>> events(const std::string& id, const std::string& last,
                                                   std::size_t count) {
    std::vector<std::pair<std::size_t, json>> all;
    std::string text;
    httplib::Headers headers;
    if (!last.empty()) headers.emplace("Last-Event-ID", last);
    client().Get(
        "/api/sessions/" + id + "/live", headers, [&](const char* bytes, std::size_t size) {
          text.append(bytes, size);
          for (std::size_t end; (end = text.find("\n\n")) != std::string::npos;
               text.erase(0, end + 2)) {
            if (text.rfind("id: ", 0) != 0) continue;
            all.emplace_back(
                std::stoul(text.substr(4)),
                json::parse(text.substr(text.find("data: ") + 6, end - text.find("data: ") - 6),
                            nullptr, false));
          }
          return all.size() < count;
        });
    return all;
  }

 private:
  void say(const std::string& url) {
    const std::lock_guard lock(mutex_);
    url_ = url;
  }
  ConsoleSettings settings_;
  std::mutex mutex_;
  std::string url_, key_;
  std::thread thread_;
};

struct Desk {
  explicit Desk(const std::string& name) : folder(name) {
    console = std::make_unique<Served>(folder / "home", sockets.path());
  }
  std::string begin() {
    json told;
    EXPECT_EQ(
        console->post("/api/sessions", {{"task", "paracentesis"}, {"operator", "expert"}}, &told),
        201)
        << told.dump();
    return told.value("id", "");
  }
  void restart() {
    console.reset();
    console = std::make_unique<Served>(folder / "home", sockets.path());
  }
  bool isState(const std::string& id, const std::string& state) {
    return inTime([&] { return console->get("/api/sessions/" + id)["state"] == state; });
  }
  const test::ScratchFolder folder;
  const test::ShortFolder sockets;
  std::unique_ptr<Served> console;
};

}  // namespace palpa::console
