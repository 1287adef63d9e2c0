#pragma once

#include <string>

#include "apps/live/live_sink.h"
#include "apps/live/port.h"
#include "apps/live/stop_port.h"
#include "apps/runtime/stop_switch.h"
#include "apps/trial/trial_status.h"

namespace palpa::live {

/// What a session says of itself to whoever looks on.
struct Hello {
  std::string uuid, task, trainee;
  bool simulated = false, assessed = false;
  int trials = 1;
};

/// A session as others see it: its log, its pictures, and what they ask of it.
class LiveSession {
 public:
  LiveSession(const std::string& socket, const Hello& hello, trial::Channels& channels,
              runtime::StopSwitch& stop);

  LiveLog& log() { return log_; }
  /// Tells what is left. False: the line to those who look on hangs in a call, and is left behind.
  bool end() { return port_.end(); }
  /// That line has served nobody for so long; any thread.
  bool silentFor(std::chrono::nanoseconds time) const { return port_.silentFor(time); }
  /// On the scene's thread, once a frame: what is on the screen in words. Told when it has changed,
  /// at most five times a second.
  void show(const scene::Hud& hud, const trial::TrialStatus& status, std::int64_t now_ns);
  /// A picture is wanted now: at most 15 a second, and none while nobody looks.
  bool wantsPicture(std::int64_t now_ns) const {
    return port_.wantsPicture() && now_ns >= next_picture_ns_;
  }
  void picture(scene::Image picture, std::int64_t now_ns);

 private:
  void receive(const std::string& command);

  LiveLog log_;
  trial::Channels& channels_;
  runtime::StopSwitch& stop_;
  std::string published_;  ///< the last status, without its time
  int refused_ = 0;        ///< told: a peer that sends nonsense for hours shall not fill the memory
  std::int64_t next_words_ns_ = 0, next_picture_ns_ = 0;
  Port port_;  ///< after what its thread uses
  StopPort stop_port_;
};

}  // namespace palpa::live
