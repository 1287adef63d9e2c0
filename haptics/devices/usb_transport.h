#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace palpa::haptics {

/// What became of a USB request.
enum class UsbStatus : std::uint8_t {
  ok,
  timeout,  ///< nothing (or not all) went through in the time given
  stall,    ///< the endpoint refused; the transport has cleared it
  gone,     ///< no such device is plugged in, or it has been unplugged
  denied,   ///< this user may not open it (open() only)
  busy,     ///< another program holds it (open() only)
  other,
};

/// Outgoing vendor request without data: bmRequestType 0x40, wIndex 0.
struct UsbControl {
  std::uint8_t request = 0;
  std::uint16_t value = 0;
};

/// One USB device with one interface. Calls block up to their time-out and belong into a driver's
/// own thread; nothing throws. Real: LibusbTransport. Tests put a scripted device here.
class UsbTransport {
 public:
  virtual ~UsbTransport() = default;
  /// Opens and claims; may be called again after close().
  virtual UsbStatus open() noexcept = 0;
  virtual void close() noexcept = 0;
  virtual UsbStatus control(const UsbControl& request, unsigned timeout_ms) noexcept = 0;
  virtual UsbStatus bulkOut(std::span<const std::uint8_t> bytes, unsigned timeout_ms) noexcept = 0;
  /// One transfer of at most `into.size()` bytes; `got` says how many came.
  virtual UsbStatus bulkIn(std::span<std::uint8_t> into, std::size_t& got,
                           unsigned timeout_ms) noexcept = 0;
};

}  // namespace palpa::haptics
