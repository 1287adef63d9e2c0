#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "apps/os/local_socket.h"
#include "apps/os/socket.h"

namespace palpa::live {

/// The session's own socket for the emergency stop. Its thread does nothing else, and does not give
/// way: no log, picture or request stands before a stop. Only processes of the same user are
/// accepted; whoever is silent makes room for the next.
class StopPort {
 public:
  /// `pressed`: called on this port's thread for each stop, before it is confirmed; it waits for
  /// nothing. Throws Error where there can be no socket at `path`, or no thread.
  StopPort(const std::string& path, std::function<void()> pressed);
  ~StopPort();
  StopPort(const StopPort&) = delete;
  StopPort& operator=(const StopPort&) = delete;

 private:
  struct Presser;
  void run();
  void letIn();
  bool hear(Presser& presser);

  const std::function<void()> pressed_;
  const os::LocalListener listener_;
  os::WakeUp ending_;
  std::vector<std::unique_ptr<Presser>> pressers_;
  std::thread thread_;
};

}  // namespace palpa::live
