#include "apps/session/session_watch.h"

#include <algorithm>
#include <array>
#include <map>

#include "apps/os/socket.h"

namespace palpa::session {
namespace {

// The signal waits no longer for us than for the tick that takes the force away.
constexpr std::int64_t kSignalPeriod = 5 * runtime::kMillisecond;
constexpr std::int64_t kVirtualPeriod = 50 * runtime::kMillisecond;
constexpr std::int64_t kStuckPeriod = 250 * runtime::kMillisecond;
constexpr std::int64_t kStuck = 2 * runtime::kSecond;
// What may take long: a device without power is greeted for seconds, a firmware takes as long.
constexpr std::int64_t kSlowStuck = 10 * runtime::kSecond;
constexpr int kKeyWait_ms = 50;
constexpr int kMostTold = 4;  // of one part's silences; a slow computer's would hide all else

}  // namespace

std::string partInWords(const std::string& activity) {
  static const std::map<std::string, std::string> kWords{
      {"scene", "the picture"},
      {"camera", "the camera"},
      {"recorder", "the evidence"},
      {"room film", "the camera in the room"},
      {"device", "the haptic device"},
      {"haptic", "the haptic loop"},
      {"igtl", "OpenIGTLink"},
      {"tracker", "the tracker"},
      {"task", "the task"},
      {"geometry", "the geometry"},
      {"stop key", "the space bar's thread"},
      {"progress", "the terminal"},
      {"console", "the line to the console"},
      {"force sensor", "the force sensor"},
      {"sound", "the sound"},
      {"force guard", "the line to the force guard"}};
  const auto found = kWords.find(activity);
  return found == kWords.end() ? activity : found->second;
}

namespace {

bool has(const runtime::Executive::Stuck& stuck, const std::string& activity) {
  return std::find(stuck.begin(), stuck.end(), activity) != stuck.end();
}

}  // namespace

std::int64_t SessionWatch::step(std::int64_t now_ns) {
  if (note_.noted()) return endSession("Interrupted", now_ns);
  if (window_lost_.load()) return endSession("The window is gone", now_ns);
  if (executive_.mode() == runtime::TimeMode::virtual_time) return now_ns + kVirtualPeriod;
  if (now_ns >= next_look_ns_) nameTheStuck(now_ns);
  return now_ns + kSignalPeriod;
}

/// The task ends the session; one that hangs is not waited for.
std::int64_t SessionWatch::endSession(const char* why, std::int64_t now_ns) {
  stop_.end();
  if (!heard_) heard_ = channels_.signals_to_task.push({trial::UserCommand::quit, why});
  if (executive_.mode() == runtime::TimeMode::virtual_time)
    return heard_ ? runtime::kNever : now_ns + kVirtualPeriod;
  if (asked_ns_ < 0) asked_ns_ = now_ns;
  if (now_ns - asked_ns_ > kStuck) executive_.stop();
  return now_ns + kSignalPeriod;
}

void SessionWatch::nameTheStuck(std::int64_t now_ns) {
  next_look_ns_ = now_ns + kStuckPeriod;
  for (const auto& ask : news_)
    if (const std::string words = ask(); !words.empty())
      channels_.signals_to_task.push({trial::UserCommand::remark, words, 1});
  runtime::Executive::Stuck stuck = stuckNow();
  for (const std::string& name : stuck)
    if (!has(stuck_, name)) tellSilent(name);
  for (const std::string& name : stuck_)
    if (!has(stuck, name)) tellBack(name);
  stuck_ = std::move(stuck);
}

runtime::Executive::Stuck SessionWatch::stuckNow() const {
  runtime::Executive::Stuck stuck = executive_.stuckFor(kStuck);
  if (device_ && !device_->mayPush() && !has(executive_.stuckFor(kSlowStuck), device_->name()))
    std::erase(stuck, device_->name());
  if (console_ && console_->silentFor(live::kLineHangs)) stuck.push_back("console");
  return stuck;
}

/// A device's motors keep what they had, whatever is asked of them. One that was not ready was sent
/// no force, and is no matter for the report: its driver says what it lacks.
void SessionWatch::tellSilent(const std::string& activity) {
  const bool device = device_ && activity == device_->name(), pushes = device && device_->mayPush();
  const int time = ++silences_[activity];
  if (time > kMostTold && !pushes) return;
  const std::string words =
      partInWords(activity) + " does not answer" +
      (pushes ? " and may keep its last force: switch its power off" : "") +
      (time == kMostTold && !pushes ? " once more: the computer is too slow; this is not told again"
                                    : "; all other parts go on");
  channels_.signals_to_task.push({trial::UserCommand::remark, words, device && !pushes ? 0. : 1.});
}

void SessionWatch::tellBack(const std::string& activity) {
  const bool device = device_ && activity == device_->name();
  if (silences_[activity] >= kMostTold && !device) return;
  channels_.signals_to_task.push(
      {trial::UserCommand::remark, partInWords(activity) + " answers again", 0});
}

std::int64_t StopKeyWatch::step(std::int64_t now_ns) {
  const int server = key_.descriptor();
  if (server < 0) return runtime::kNever;
  if (key_.pressed()) stop_.press();
  const std::array<os::WatchedSocket, 1> watched{{{server}}};
  os::waitForAny(watched, kKeyWait_ms);
  if (key_.pressed()) stop_.press();
  return now_ns;
}

void PedalWatch::hear() {
  if (!pedal_.pressed()) return;
  stop_.press();
  gone_.store(pedal_.descriptor() < 0);
}

std::string PedalWatch::news() {
  return gone_.exchange(false)
             ? "The stop pedal is gone. Forces are off; without it use the space bar"
             : "";
}

std::int64_t PedalWatch::step(std::int64_t now_ns) {
  hear();
  if (pedal_.descriptor() < 0) return runtime::kNever;
  const std::array<os::WatchedSocket, 1> watched{{{pedal_.descriptor()}}};
  os::waitForAny(watched, kKeyWait_ms);
  hear();
  return now_ns;
}

}  // namespace palpa::session
