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
constexpr int kKeyWait_ms = 50;

}  // namespace

std::string partInWords(const std::string& activity) {
  static const std::map<std::string, std::string> kWords{
      {"scene", "the picture"},
      {"camera", "the camera"},
      {"recorder", "the evidence"},
      {"falcon", "the haptic device"},
      {"haptic", "the haptic loop"},
      {"igtl", "OpenIGTLink"},
      {"tracker", "the tracker"},
      {"task", "the task"},
      {"geometry", "the geometry"},
      {"stop key", "the space bar's thread"},
      {"progress", "the terminal"},
      {"console", "the line to the console"},
      {"force sensor", "the force sensor"},
      {"force guard", "the line to the force guard"}};
  const auto found = kWords.find(activity);
  return found == kWords.end() ? activity : found->second;
}

namespace {

/// A device's motors keep what they had, whatever is asked of them.
std::string silenceInWords(const std::string& activity) {
  return partInWords(activity) + " does not answer" +
         (activity == "falcon" ? " and may keep its last force: switch its power off" : "") +
         "; all other parts go on";
}

std::string returnInWords(const std::string& activity) {
  return partInWords(activity) + " answers again";
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
  runtime::Executive::Stuck stuck = executive_.stuckFor(kStuck);
  if (console_ && console_->silentFor(std::chrono::nanoseconds(kStuck))) stuck.push_back("console");
  const auto tell = [this](const runtime::Executive::Stuck& of,
                           const runtime::Executive::Stuck& not_in,
                           std::string (*words)(const std::string&), double in_report) {
    for (const std::string& name : of)
      if (std::find(not_in.begin(), not_in.end(), name) == not_in.end())
        channels_.signals_to_task.push({trial::UserCommand::remark, words(name), in_report});
  };
  tell(stuck, stuck_, silenceInWords, 1);
  tell(stuck_, stuck, returnInWords, 0);
  stuck_ = std::move(stuck);
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

}  // namespace palpa::session
