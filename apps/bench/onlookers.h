#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "apps/console/session_link.h"
#include "apps/live/port.h"
#include "apps/runtime/clock.h"

namespace palpa::bench {

/// Who looks on beside a measurement: the session's port, which encodes and sends, the console's
/// end of it, and as many pages as are asked for, each of which takes every picture. Threads of
/// their own at low priority, as in a session with a console.
class Onlookers {
 public:
  explicit Onlookers(int pages);  ///< throws Error where there can be no local socket
  ~Onlookers();

  /// On the scene's thread, once a frame.
  bool wantPicture() const { return port_.wantsPicture() && clock_.now() >= next_ns_; }
  void show(scene::Image picture);
  /// All pages together.
  int pictures() const { return pictures_.load(); }

 private:
  void look();

  live::LiveLog log_;
  const std::string path_;
  live::Port port_;
  console::SessionLink link_;
  std::atomic<bool> ending_{false};
  std::atomic<int> pictures_{0};
  const runtime::SteadyClock clock_;  // goes on from segment to segment
  std::int64_t next_ns_ = 0;
  std::vector<std::thread> pages_;
};

}  // namespace palpa::bench
