#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace palpa::haptics {

/// What became of a line of text on a serial port.
enum class SerialStatus : std::uint8_t {
  ok,
  timeout,  ///< nothing, or no whole line, came in the time given
  gone,     ///< there is no such port, or it has been unplugged
  denied,   ///< this user may not open it
  other,
};

/// A device on a serial port that speaks in lines of text, at most 255 bytes each: 8 bits, no
/// parity, no flow control. Calls block up to their time-out and belong into a driver's own thread.
class SerialLine {
 public:
  explicit SerialLine(std::string port) : port_(std::move(port)) {}
  ~SerialLine() { close(); }
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// May be called again after close(); what the device said before is forgotten.
  SerialStatus open() noexcept;
  void close() noexcept;
  SerialStatus send(std::string_view line) noexcept;  ///< without its end
  /// The next line without its end, valid until the next call; empty where none came.
  SerialStatus receive(std::string_view& line, int timeout_ms) noexcept;

 private:
  bool takeLine(std::string_view& line) noexcept;
  const std::string port_;
  int port_number_ = -1;
  char bytes_[512]{};
  std::size_t size_ = 0, taken_ = 0;
};

}  // namespace palpa::haptics
