#pragma once

#include "haptics/devices/usb_transport.h"

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

}  // namespace palpa::haptics
