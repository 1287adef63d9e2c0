#pragma once

#include <string>

namespace palpa::os {

/// A foot switch or a box of buttons as the kernel gives it (/dev/input/by-id/...-event-kbd): read
/// by this process itself, so that it is heard whatever the desktop does, and taken for itself, so
/// that it types nothing into other programs. Nothing here waits.
class Pedal {
 public:
  /// Throws Error where the device is not there or this user may not read it.
  explicit Pedal(const std::string& device);
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
