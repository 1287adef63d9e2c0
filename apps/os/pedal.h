#pragma once

#include <string>

namespace palpa::os {

/// A foot switch or a box of buttons as the kernel gives it (/dev/input/by-id/...-event-kbd): read
/// by this process itself, so that it is heard whatever the desktop does, and taken for itself, so
/// that it types nothing into other programs. Nothing here waits.
class Pedal {
 public:
  enum class Use {
    alone,  ///< nobody else hears it meanwhile
    look    ///< whether it can be heard at all; a session that runs may have it
  };
  /// Throws Error where the device is not there, has no keys, is another program's, or may not be
  /// read by this user. A named pipe is taken as well, to try it.
  explicit Pedal(const std::string& device, Use use = Use::alone);
  ~Pedal();
  Pedal(const Pedal&) = delete;
  Pedal& operator=(const Pedal&) = delete;

  int descriptor() const { return descriptor_; }  ///< -1: it is gone
  /// A key or button of it went down since the last call, or it is gone since.
  bool pressed();

 private:
  void letGo();
  int descriptor_ = -1;
};

}  // namespace palpa::os
