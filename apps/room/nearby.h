#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/room/found_consoles.h"

namespace palpa::room {

/// Consoles on the local network, by mDNS (DNS-SD, "_palpa._tcp") as Debian's avahi-daemon speaks
/// it: announces one, finds the others, or both. A thread of its own, which gives way to all
/// others. Without that daemon nothing is announced and found, and `trouble` says so; it is asked
/// again every now and then. Any thread.
class Nearby {
 public:
  struct Wish {
    std::optional<FoundConsole> announces;  ///< host and name are the computer's
    bool looks = false;                     ///< for others
  };
  explicit Nearby(const Wish& wish);
  ~Nearby();
  Nearby(const Nearby&) = delete;
  Nearby& operator=(const Nearby&) = delete;

  /// Without this one.
  std::vector<FoundConsole> found() const;
  std::string trouble() const;  ///< why nobody is announced or found; empty: they are

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;  ///< with the thread: what hangs keeps what it uses
};

}  // namespace palpa::room
