#include "apps/console/web/lobby.h"

#include <algorithm>
#include <map>

#include "apps/console/web/http_framing.h"

namespace palpa::console {
namespace {

using namespace std::chrono_literals;
constexpr std::chrono::milliseconds kSilent = 5s, kHeadWithin = 10s;
constexpr std::chrono::milliseconds kCrowdedSilent = 250ms,
                                    kCrowdedHeadWithin = 2s;  // who says nothing makes room
constexpr std::chrono::milliseconds kNoDescriptor = 10ms;
constexpr int kLobbyLook_ms = 100;
constexpr int kCallersAtOnce = 64;
constexpr std::size_t kLongestHead = 32u << 10, kLongestStop = 1u << 10;

constexpr char kFull[] =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\nRetry-After: "
    "5\r\n\r\n";

/// By its first line; whether it may is the guard's.
bool isEmergencyStop(const std::string& said) {
  constexpr std::string_view kMethod = "POST ", kVersion = " HTTP/1.1";
  const std::string_view line = std::string_view(said).substr(0, said.find('\r'));
  if (!line.starts_with(kMethod) || !line.ends_with(kVersion)) return false;
  return isStopPath(
      std::string(line.substr(kMethod.size(), line.size() - kMethod.size() - kVersion.size())));
}

}  // namespace

Caller::Caller(std::unique_ptr<os::Line> from)
    : socket(from->socket()), line(std::move(from)), since(runtime::ServingClock::now()) {
  if (const auto address = os::peerOf(socket)) remote = address->ip;
}

Caller::~Caller() {
  line.reset();
  os::endBoth(socket);
  os::closeSocket(socket);
}

/// One that was answered before is closed without a word: a word could be taken for the answer to
/// a request that is on its way.
void turnAway(const Caller& caller) {
  if (caller.answered == 0 || !caller.said.empty()) caller.line->sendSome(kFull, sizeof kFull - 1);
}

void Lobby::run(int listener) {
  while (!ending_.load()) {
    wait(listener);
    takeBack();
    letIn(listener);
    makeRoom();
    hearAll();
  }
  waiting_.clear();
  const std::lock_guard lock(mutex_);
  back_.clear();
}

void Lobby::end() {
  ending_.store(true);
  wake_.wake();
}

void Lobby::comeBack(std::unique_ptr<Caller> caller) {
  caller->since = Clock::now();
  const std::lock_guard lock(mutex_);
  if (ending_.load()) return;
  back_.push_back(std::move(caller));
  wake_.wake();
}

void Lobby::wait(int listener) {
  std::vector<os::WatchedSocket> all{{listener}, {wake_.descriptor()}};
  for (const auto& caller : waiting_) all.push_back({caller->socket});
  os::waitForAny(all, kLobbyLook_ms);
}

void Lobby::takeBack() {
  wake_.taken();
  const std::lock_guard lock(mutex_);
  for (auto& caller : back_) waiting_.push_back(std::move(caller));
  back_.clear();
}

void Lobby::letIn(int listener) {
  for (int callers = 0; callers < kCallersAtOnce && os::ready(listener, os::Wait::to_read, 0);
       ++callers) {
    const int socket = os::acceptOne(listener);
    if (socket < 0 && socket != os::kNoMoreSockets) continue;  // gone already
    if (socket < 0) {                                          // one who waits gives theirs
      if (waiting_.empty()) return runtime::rest(kNoDescriptor);
      waiting_.erase(waiting_.begin());
      return ways_.away();
    }
    os::sendAtOnce(socket);
    std::unique_ptr<os::Line> line = lineOver(socket);
    if (!line) return ways_.away();
    waiting_.push_back(std::make_unique<Caller>(std::move(line)));
    if (!hear(waiting_.back())) waiting_.pop_back();
    makeRoom();
  }
}

/// Null where there is no memory left for it: that one goes.
std::unique_ptr<os::Line> Lobby::lineOver(int socket) const {
  try {
    return ways_.line(socket);
  } catch (const std::exception&) {
    os::closeSocket(socket);
    return nullptr;
  }
}

/// Nobody has more than a share, and all together no more than there are places.
void Lobby::makeRoom() {
  std::map<std::string, std::size_t> of;
  for (const auto& caller : waiting_) ++of[caller->remote];
  const auto most = [&of] {
    return std::max_element(of.begin(), of.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; });
  };
  while (!of.empty() && (most()->second > kMostOfOne || waiting_.size() > kMost)) {
    const auto address = most();
    const auto first = std::find_if(waiting_.begin(), waiting_.end(), [&](const auto& caller) {
      return caller->remote == address->first;
    });
    turnAway(**first);
    waiting_.erase(first);
    --address->second;
    ways_.away();
  }
}

void Lobby::hearAll() {
  for (auto& caller : waiting_)
    if (!hear(caller)) caller.reset();
  std::erase(waiting_, nullptr);
}

/// False: it has gone, or on; or it took too long.
bool Lobby::hear(std::unique_ptr<Caller>& caller) {
  char bytes[4096];
  bool left = false;
  const bool greeted = caller->line->greets();
  for (std::size_t count = 1; count > 0 && caller->said.size() < kLongestHead;) {
    const std::optional<std::size_t> got = caller->line->receiveSome(bytes, sizeof bytes);
    left = !got;
    count = got.value_or(0);
    if (count > 0 && caller->said.empty()) caller->since = Clock::now();
    caller->said.append(bytes, count);
  }
  if (greeted && !caller->line->greets()) caller->since = Clock::now();  // now it may speak
  const std::optional<std::size_t> stop = stopLengthOf(*caller);
  if (stop && caller->said.size() >= *stop) return ways_.stop(std::move(caller)), false;
  const bool whole = !stop && endOfHead(caller->said) != std::string::npos;
  if (whole || caller->said.size() >= kLongestHead || (left && !caller->said.empty()))
    return ways_.request(std::move(caller)), false;
  if (left) return false;
  if (!isOver(*caller)) return true;
  if (!caller->said.empty()) ways_.slow(caller->remote);
  return false;
}

/// How long a stop is that may, its few bytes of body too: nobody will have to wait for it. Nothing
/// where it is none, or its head is not all here.
std::optional<std::size_t> Lobby::stopLengthOf(const Caller& caller) const {
  const std::size_t end = endOfHead(caller.said);
  if (end == std::string::npos || !isEmergencyStop(caller.said)) return std::nullopt;
  const std::string_view head = std::string_view(caller.said).substr(0, end);
  const std::optional<std::size_t> body = bodyLengthIn(head);
  if (!body || *body > kLongestStop || !ways_.may_stop(head, caller.remote)) return std::nullopt;
  return end + *body;
}

bool Lobby::isOver(const Caller& caller) const {
  const bool silent = caller.said.empty() && !caller.line->greets();
  const auto patience = silent ? (crowded() ? kCrowdedSilent : kSilent)
                               : (crowded() ? kCrowdedHeadWithin : kHeadWithin);
  return Clock::now() - caller.since > patience;
}

}  // namespace palpa::console
