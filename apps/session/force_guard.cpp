#include "apps/session/force_guard.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "anatomy/base/error.h"
#include "apps/os/signals.h"
#include "apps/os/socket.h"
#include "apps/runtime/clock.h"

namespace palpa::session {
namespace {

constexpr const char* kGuardWord = "force-guard";
constexpr char kAlive = '.', kFarewell = 'q';
constexpr std::int64_t kSignOfLife = 50 * runtime::kMillisecond;
constexpr int kSilent_ms = 200;  // four signs of life are missing
constexpr std::int64_t kClaimPatience = 3 * runtime::kSecond;

/// Whether a farewell came; nothing: the other side is gone.
std::optional<bool> farewellFrom(int line) {
  char signs[64];
  const std::optional<std::size_t> count = os::receiveSome(line, signs, sizeof signs);
  if (!count) return std::nullopt;
  return std::find(signs, signs + *count, kFarewell) != signs + *count;
}

}  // namespace

ForceGuard::ForceGuard(const haptics::DriverDescription& device,
                       const haptics::DriverSettings& settings) {
  if (os::programName() != "palpa") return;
  const os::ProcessId self = os::thisProcess();
  std::vector<std::string> words{kGuardWord, std::to_string(self.pid), std::to_string(self.began),
                                 device.name};
  for (std::string& word : settings.words()) words.push_back(std::move(word));
  try {
    guard_ = os::startWithLine(words);
  } catch (const Error&) {  // told at the ready check: nobody stands
  }
}

ForceGuard::~ForceGuard() {
  if (guard_.line < 0) return;
  os::sendSome(guard_.line, &kFarewell, 1);
  os::closeSocket(guard_.line);
}

std::int64_t ForceGuard::step(std::int64_t now_ns) {
  if (guard_.line < 0 || !os::sendSome(guard_.line, &kAlive, 1)) return runtime::kNever;
  return now_ns + kSignOfLife;
}

bool ForceGuard::stands() const { return guard_.line >= 0 && os::runs(guard_.process); }

GuardWatch watchSession(int line, const os::ProcessId& session) {
  for (;;) {
    if (!os::ready(line, os::Wait::to_read, kSilent_ms)) {
      if (!os::isStopped(session)) continue;
      os::endAtOnce(session);
      return GuardWatch::stopped;
    }
    const std::optional<bool> farewell = farewellFrom(line);
    if (!farewell) return GuardWatch::dead;
    if (*farewell) return GuardWatch::dismissed;
  }
}

/// Nobody commands: a driver's exchanges carry zero then, the last one in any case.
bool takeForceAway(haptics::Driver& driver) {
  const runtime::SteadyClock clock;
  driver.open();
  const auto talks = [&driver] {
    const haptics::DriverState state = driver.status().state;
    return state == haptics::DriverState::homing || state == haptics::DriverState::ready;
  };
  for (std::int64_t now = clock.now(); now < kClaimPatience && !talks(); now = clock.now()) {
    const std::int64_t due_ns = driver.step(now);
    if (!talks()) clock.sleepUntil(std::min(due_ns, now + 5 * runtime::kMillisecond));
  }
  const bool taken = talks();
  driver.close();
  return taken;
}

bool isGuard(const std::vector<std::string>& words) {
  return words.size() >= 4 && words[0] == kGuardWord;
}

int standGuard(const std::vector<std::string>& words) {
  const os::InterruptNote goes_on;  // whatever ends the session must not end its guard
  constexpr int kLine = 0;
  const os::ProcessId session{std::atoi(words[1].c_str()),
                              std::strtoull(words[2].c_str(), nullptr, 10)};
  if (watchSession(kLine, session) == GuardWatch::dismissed) return EXIT_SUCCESS;
  const haptics::DriverDescription* const device = haptics::driverNamed(words[3]);
  if (!device) return EXIT_FAILURE;
  const std::unique_ptr<haptics::Driver> driver = device->make(
      haptics::DriverSettings::ofWords({words.begin() + 4, words.end()}, device->fields));
  return takeForceAway(*driver) ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace palpa::session
