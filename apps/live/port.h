#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/live/live_sink.h"
#include "apps/live/wire.h"
#include "apps/os/local_socket.h"
#include "scene/scene_state.h"

namespace palpa::live {

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
  ~Port();  ///< tells what is left, for at most half a second

  /// Somebody wants pictures, and the last one is gone.
  bool wantsPicture() const {
    return watched_.load(std::memory_order_relaxed) &&
           !has_picture_.load(std::memory_order_acquire);
  }
  void offer(scene::Image picture);

 private:
  struct Peer;
  void run();
  void waitForPeers(int timeout_ms);
  void accept();
  void read(Peer& peer);
  void apply(Peer& peer);
  void write(Peer& peer);
  void sendTo(Peer& peer);
  void encodePicture();
  void leaveLost();
  bool allSent() const;

  const LiveLog& log_;
  const Received received_;
  const std::chrono::milliseconds patience_;
  const os::LocalListener listener_;
  std::vector<std::unique_ptr<Peer>> peers_;
  std::atomic<bool> watched_{false}, has_picture_{false}, ending_{false};
  std::mutex picture_mutex_;
  scene::Image picture_;
  std::thread thread_;
};

/// An RGB picture as JPEG, no wider than `widest` (0: as it is); quality 1 to 100.
std::string jpegOf(const scene::Image& image, int quality, int widest = 0);

}  // namespace palpa::live
