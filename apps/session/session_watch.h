#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "apps/live/live_session.h"
#include "apps/os/pedal.h"
#include "apps/os/signals.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/device_activity.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/stop_switch.h"
#include "apps/trial/trial_status.h"
#include "scene/window/stop_key.h"

namespace palpa::session {

/// Past whatever hangs, on a thread of its own. A signal to end (Ctrl-C, SIGTERM, a terminal that
/// is gone) and a lost window close a session as Escape does, but the force is gone with the next
/// tick: the trial is ended, files are written. A part that does not answer for two seconds is
/// named in the record and to whoever looks on, and again when it is back; ten seconds are left to
/// a device that is not ready yet, as its firmware is sent in one step, and to the console's line,
/// which gives way to all others.
class SessionWatch final : public runtime::Activity {
 public:
  /// `device`: of a real one, or null. `console`: who looks on, if anybody may.
  SessionWatch(runtime::Executive& executive, trial::Channels& channels, runtime::StopSwitch& stop,
               const runtime::DriverActivity* device, const live::LiveSession* console)
      : executive_(executive),
        channels_(channels),
        stop_(stop),
        device_(device),
        console_(console) {}
  const char* name() const override { return "watch"; }
  std::int64_t step(std::int64_t now_ns) override;

  /// Asked now and then for what is new of a part that has no line of its own; empty: nothing.
  void listenTo(std::function<std::string()> news) { news_.push_back(std::move(news)); }
  void windowIsLost() noexcept { window_lost_.store(true); }  ///< any thread

 private:
  std::int64_t endSession(const char* why, std::int64_t now_ns);
  void nameTheStuck(std::int64_t now_ns);
  runtime::Executive::Stuck stuckNow() const;
  void tellSilent(const std::string& activity);
  void tellBack(const std::string& activity);

  runtime::Executive& executive_;
  trial::Channels& channels_;
  runtime::StopSwitch& stop_;
  const runtime::DriverActivity* const device_;
  const live::LiveSession* const console_;
  std::atomic<bool> window_lost_{false};
  os::InterruptNote note_;
  std::vector<std::function<std::string()>> news_;
  runtime::Executive::Stuck stuck_;      ///< as last named
  std::map<std::string, int> silences_;  ///< of each part so far
  std::int64_t next_look_ns_ = 0;
  std::int64_t asked_ns_ = -1;  ///< the session was asked to end
  bool heard_ = false;          ///< there was room for the request
};

/// What a person calls a part of the session: "the picture" for "scene".
std::string partInWords(const std::string& activity);

/// The space bar's thread. Real time only: a step lasts until something comes, or 50 ms.
class StopKeyWatch final : public runtime::Activity {
 public:
  StopKeyWatch(scene::StopKey& key, runtime::StopSwitch& stop) : key_(key), stop_(stop) {}
  const char* name() const override { return "stop key"; }
  std::int64_t step(std::int64_t now_ns) override;

 private:
  scene::StopKey& key_;
  runtime::StopSwitch& stop_;
};

/// The stop pedal's thread, whatever the desktop does. One that is pulled out stops, too: nobody
/// knows any more whether it would be heard. Real time only.
class PedalWatch final : public runtime::Activity {
 public:
  /// Throws Error as os::Pedal does.
  PedalWatch(const std::string& device, runtime::StopSwitch& stop) : pedal_(device), stop_(stop) {}
  const char* name() const override { return "stop pedal"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// That it is gone, once; any thread.
  std::string news();

 private:
  void hear();
  os::Pedal pedal_;
  runtime::StopSwitch& stop_;
  std::atomic<bool> gone_{false};
};

}  // namespace palpa::session
