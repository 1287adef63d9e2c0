#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "apps/live/live_sink.h"
#include "apps/os/local_socket.h"
#include "scene/scene_state.h"

namespace palpa::live {

/// The port's thread gives way to all others and may wait long for its turn: that it hangs is said
/// after so long.
inline constexpr std::chrono::seconds kLineHangs{10};

/// The session's end of the local socket: tells its log and its pictures to up to eight who look
/// on, hears what they ask. A thread of its own at low priority; whoever is slow gets fewer
/// pictures, who takes nothing is left, and nobody who looks on can hold the session up. Only
/// processes of the same user are accepted.
class Port {
 public:
  /// Called on the port's thread with the body of a command.
  using Received = std::function<void(const std::string& command)>;
  /// Throws Error where there can be no socket at `path`, or no thread.
  /// `patience`: whoever has taken nothing off for so long while something waits is left; he may
  /// come again.
  Port(const std::string& path, const LiveLog& log, Received received,
       std::chrono::milliseconds patience = std::chrono::seconds(10));
  ~Port();  ///< as end()
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Tells what is left, for at most half a second. False: its thread hangs in a call and is left
  /// behind, `kLineHangs` later; it touches neither `log` nor `received` any more.
  bool end();
  /// Nobody has been served for so long: its thread hangs. Any thread.
  bool silentFor(std::chrono::nanoseconds time) const;
  /// Somebody wants pictures, and the last one is gone.
  bool wantsPicture() const;
  void offer(scene::Image picture);

 private:
  class Line;
  const os::LocalListener listener_;
  const std::shared_ptr<Line> line_;  ///< its thread's as well
  std::future<void> over_;
  std::thread thread_;
};

/// An RGB picture as JPEG, no wider than `widest` (0: as it is); quality 1 to 100.
std::string jpegOf(const scene::Image& image, int quality, int widest = 0);

}  // namespace palpa::live
