#pragma once

#include <array>
#include <span>

#include "haptics/devices/usb_transport.h"

namespace palpa::haptics {

/// What an IN packet of the chip carried beside its status.
struct FtdiPayload {
  std::array<std::uint8_t, 62> bytes{};
  std::size_t size = 0;
  std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};

/// The FTDI USB-serial chip in front of a microcontroller: vendor requests, and the two status
/// bytes (modem, line) that lead every IN packet of at most 64 bytes, which are taken off here.
/// With nothing to say the chip sends the status alone each time its latency timer ends: an empty
/// payload.
class FtdiSerial {
 public:
  explicit FtdiSerial(UsbTransport& usb) : usb_(usb) {}

  UsbStatus purge() noexcept;  ///< forgets what waits in either direction
  UsbStatus latency(std::uint16_t ms) noexcept;
  UsbStatus baudDivisor(std::uint16_t divisor) noexcept;
  UsbStatus eightBitsNoFlowControl() noexcept;
  UsbStatus rts(bool high) noexcept;
  UsbStatus dtr(bool high) noexcept;
  UsbStatus write(std::span<const std::uint8_t> bytes) noexcept;
  UsbStatus read(FtdiPayload& payload) noexcept;  ///< one packet

 private:
  UsbStatus control(std::uint8_t request, std::uint16_t value) noexcept;
  UsbTransport& usb_;
};

}  // namespace palpa::haptics
