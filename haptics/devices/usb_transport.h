#pragma once

#include <array>
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

struct libusb_context;
struct libusb_device;
struct libusb_device_handle;

namespace palpa::haptics {

/// Which device, and where its data goes in and out.
struct UsbAddress {
  std::uint16_t vendor = 0, product = 0;
  std::uint8_t endpoint_out = 0, endpoint_in = 0;
};

/// UsbTransport on libusb: takes the first device of that kind that nobody holds, detaches a kernel
/// driver while it is open, clears an endpoint that stalled, and says `gone` after an unplug.
class LibusbTransport final : public UsbTransport {
 public:
  explicit LibusbTransport(const UsbAddress& address) : address_(address) {}
  ~LibusbTransport() override;
  LibusbTransport(const LibusbTransport&) = delete;
  LibusbTransport& operator=(const LibusbTransport&) = delete;

  UsbStatus open() noexcept override;
  void close() noexcept override;
  UsbStatus control(const UsbControl& request, unsigned timeout_ms) noexcept override;
  UsbStatus bulkOut(std::span<const std::uint8_t> bytes, unsigned timeout_ms) noexcept override;
  UsbStatus bulkIn(std::span<std::uint8_t> into, std::size_t& got,
                   unsigned timeout_ms) noexcept override;

 private:
  UsbStatus claim(libusb_device* device) noexcept;
  UsbStatus bulk(std::uint8_t endpoint, std::uint8_t* bytes, std::size_t size, std::size_t& done,
                 unsigned timeout_ms) noexcept;
  UsbAddress address_;
  libusb_context* context_ = nullptr;
  libusb_device_handle* handle_ = nullptr;
};

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
