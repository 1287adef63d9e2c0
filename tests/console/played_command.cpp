#include "played_command.h"

#include <dirent.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "apps/live/live_session.h"
#include "apps/runtime/clock.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::seconds kLongestPlay{60};

std::string after(const std::vector<std::string>& arguments, const std::string& option) {
  const auto found = std::find(arguments.begin(), arguments.end(), option);
  return found == arguments.end() || found + 1 == arguments.end() ? "" : found[1];
}

/// Open descriptors beside the one that looks, whose process group and session it is, where its
/// input comes from, its priority.
int tellFacts() {
  DIR* const folder = ::opendir("/proc/self/fd");
  std::string open;
  while (const dirent* entry = ::readdir(folder))
    if (entry->d_name[0] != '.' && std::stoi(entry->d_name) != ::dirfd(folder))
      open += std::string(" ") + entry->d_name;
  ::closedir(folder);
  std::error_code none;
  sigset_t blocked;
  ::sigprocmask(SIG_BLOCK, nullptr, &blocked);
  std::printf("open%s\nown_group %d\nown_session %d\ninput %s\nblocked %d\npriority %d\n",
              open.c_str(), ::getpgrp() == ::getpid(), ::getsid(0) == ::getpid(),
              fs::read_symlink("/proc/self/fd/0", none).c_str(), ::sigismember(&blocked, SIGTERM),
              ::getpriority(PRIO_PROCESS, 0));
  return 0;
}

/// A session of one trial: an entry each 10 ms, until told to leave.
int playSession(const std::vector<std::string>& arguments) {
  trial::Channels channels;
  runtime::StopSwitch stop;
  live::LiveSession session(after(arguments, "--live"),
                            {"uuid", "paracentesis", after(arguments, "--trainee"), true, false, 1},
                            channels, stop);
  std::uint32_t presses = 0;
  const auto hear = [&](trial::UserCommand command) {
    session.log().add("{\"kind\":\"event\",\"heard\":" + std::to_string(static_cast<int>(command)) +
                      "}");
  };
  const auto until = runtime::ServingClock::now() + kLongestPlay;
  for (int number = 1; runtime::ServingClock::now() < until; ++number) {
    session.log().add(R"({"kind":"event","event":"phase","text":"on","tone":"neutral","number":)" +
                      std::to_string(number) + "}");
    if (session.wantsPicture(number * 100'000'000ll))
      session.picture({32, 32, 3, std::vector<std::uint8_t>(32 * 32 * 3, 128)},
                      number * 100'000'000ll);
    for (; presses < stop.presses(); ++presses) hear(trial::UserCommand::emergency_stop);
    trial::UserRequest request;
    while (channels.console_to_task.pop(&request)) {
      hear(request.command);
      if (request.command != trial::UserCommand::quit) continue;
      std::ofstream(fs::path(after(arguments, "--out")) / "report.html") << "<p>done</p>";
      return 0;
    }
    runtime::rest(std::chrono::milliseconds(10));
  }
  return 1;
}

int waitForEnd() {
  sigset_t interrupt;
  sigemptyset(&interrupt);
  sigaddset(&interrupt, SIGINT);
  ::sigprocmask(SIG_BLOCK, &interrupt, nullptr);
  std::printf("3 of 20\n");
  std::fflush(stdout);
  const timespec longest{kLongestPlay.count(), 0};
  ::sigtimedwait(&interrupt, nullptr, &longest);
  return 0;
}

int writePage(const std::vector<std::string>& arguments) {
  const fs::path folder = after(arguments, "--out");
  fs::create_directories(folder);
  std::ofstream(folder / (arguments.size() > 1 ? arguments[1] + ".html" : "page.html"))
      << "<!doctype html><p>page</p>";
  return 0;
}

}  // namespace

int playCommand(const std::vector<std::string>& arguments) {
  const std::string& command = arguments.front();
  if (command == "facts") return tellFacts();
  if (command == "doctor") return std::puts("{\"can_start\": true, \"findings\": []}") < 0;
  if (command == "train") return playSession(arguments);
  if (command == "report") return writePage(arguments);
  if (command == "wait") return waitForEnd();
  std::fprintf(stderr, "palpa: %s: is played by nobody. Ask for something else\n", command.c_str());
  return 2;
}

}  // namespace palpa::console
