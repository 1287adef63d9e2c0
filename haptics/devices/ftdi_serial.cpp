#include "haptics/devices/ftdi_serial.h"

#include <algorithm>

namespace palpa::haptics {
namespace {

enum FtdiRequest : std::uint8_t {
  kReset = 0,
  kModemLines = 1,
  kFlowControl = 2,
  kBaudDivisor = 3,
  kDataFormat = 4,
  kLatency = 9
};

constexpr std::uint16_t kPurgeRx = 1, kPurgeTx = 2, kEightBitsNoParityOneStop = 8;
constexpr std::size_t kStatusSize = 2, kPacketSize = 64;
constexpr unsigned kControlTimeout_ms = 1000;
constexpr unsigned kBulkTimeout_ms = 50;  // three turns of the longest latency timer in use, 16 ms

}  // namespace

UsbStatus FtdiSerial::control(std::uint8_t request, std::uint16_t value) noexcept {
  return usb_.control({request, value}, kControlTimeout_ms);
}

UsbStatus FtdiSerial::purge() noexcept {
  const UsbStatus status = control(kReset, kPurgeRx);
  return status == UsbStatus::ok ? control(kReset, kPurgeTx) : status;
}

UsbStatus FtdiSerial::latency(std::uint16_t ms) noexcept { return control(kLatency, ms); }

UsbStatus FtdiSerial::baudDivisor(std::uint16_t divisor) noexcept {
  return control(kBaudDivisor, divisor);
}

UsbStatus FtdiSerial::eightBitsNoFlowControl() noexcept {
  const UsbStatus status = control(kDataFormat, kEightBitsNoParityOneStop);
  return status == UsbStatus::ok ? control(kFlowControl, 0) : status;
}

// In both, the high byte says which line is meant, the low byte how it shall be.
UsbStatus FtdiSerial::rts(bool high) noexcept {
  return control(kModemLines, static_cast<std::uint16_t>(high ? 0x0202 : 0x0200));
}

UsbStatus FtdiSerial::dtr(bool high) noexcept {
  return control(kModemLines, static_cast<std::uint16_t>(high ? 0x0101 : 0x0100));
}

UsbStatus FtdiSerial::write(std::span<const std::uint8_t> bytes) noexcept {
  return usb_.bulkOut(bytes, kBulkTimeout_ms);
}

UsbStatus FtdiSerial::read(FtdiPayload& payload) noexcept {
  std::array<std::uint8_t, kPacketSize> packet;
  std::size_t got = 0;
  const UsbStatus status = usb_.bulkIn(packet, got, kBulkTimeout_ms);
  payload.size = status == UsbStatus::ok && got > kStatusSize ? got - kStatusSize : 0;
  std::copy_n(packet.begin() + kStatusSize, payload.size, payload.bytes.begin());
  return status;
}

}  // namespace palpa::haptics
