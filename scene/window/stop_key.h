#pragma once

#include <memory>

namespace palpa::scene {

/// The space bar over a window, on a connection of its own to the X server: it is heard while
/// whoever draws into the window hangs. A server that is gone, or a window, says nothing any more.
class StopKey {
 public:
  /// `window`: the window's number at the server that DISPLAY names.
  explicit StopKey(unsigned long window);
  ~StopKey();
  StopKey(const StopKey&) = delete;
  StopKey& operator=(const StopKey&) = delete;

  int descriptor() const;  ///< readable when there is something to hear; -1: the server is gone
  bool pressed();          ///< since the last call; never waits

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace palpa::scene
