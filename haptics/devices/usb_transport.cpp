#include "haptics/devices/usb_transport.h"

#include <libusb.h>

#include <algorithm>

namespace palpa::haptics {
namespace {

constexpr int kInterface = 0;
constexpr std::uint8_t kVendorOut = 0x40;

UsbStatus statusOf(int libusb_error) {
  switch (libusb_error) {
    case LIBUSB_SUCCESS:
      return UsbStatus::ok;
    case LIBUSB_ERROR_TIMEOUT:
      return UsbStatus::timeout;
    case LIBUSB_ERROR_PIPE:
      return UsbStatus::stall;
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return UsbStatus::gone;
    case LIBUSB_ERROR_ACCESS:
      return UsbStatus::denied;
    case LIBUSB_ERROR_BUSY:
      return UsbStatus::busy;
    default:
      return UsbStatus::other;
  }
}

bool isAt(libusb_device* device, const UsbAddress& address) {
  libusb_device_descriptor descriptor;
  return libusb_get_device_descriptor(device, &descriptor) == LIBUSB_SUCCESS &&
         descriptor.idVendor == address.vendor && descriptor.idProduct == address.product;
}

}  // namespace

LibusbTransport::~LibusbTransport() {
  close();
  if (context_) libusb_exit(context_);
}

UsbStatus LibusbTransport::open() noexcept {
  close();
  if (!context_ && libusb_init(&context_) != LIBUSB_SUCCESS) return UsbStatus::other;
  libusb_device** devices = nullptr;
  const auto count = libusb_get_device_list(context_, &devices);
  if (count < 0) return UsbStatus::other;
  UsbStatus status = UsbStatus::gone;
  for (auto i = 0 * count; i < count && status != UsbStatus::ok; ++i)
    if (isAt(devices[i], address_)) status = claim(devices[i]);
  libusb_free_device_list(devices, 1);
  return status;
}

UsbStatus LibusbTransport::claim(libusb_device* device) noexcept {
  if (const int error = libusb_open(device, &handle_)) {
    handle_ = nullptr;
    return statusOf(error);
  }
  libusb_set_auto_detach_kernel_driver(handle_, 1);
  const int error = libusb_claim_interface(handle_, kInterface);
  if (error) {
    libusb_close(handle_);
    handle_ = nullptr;
  }
  return statusOf(error);
}

void LibusbTransport::close() noexcept {
  if (!handle_) return;
  libusb_release_interface(handle_, kInterface);
  libusb_close(handle_);
  handle_ = nullptr;
}

UsbStatus LibusbTransport::control(const UsbControl& request, unsigned timeout_ms) noexcept {
  if (!handle_) return UsbStatus::gone;
  const int done = libusb_control_transfer(handle_, kVendorOut, request.request, request.value, 0,
                                           nullptr, 0, timeout_ms);
  return statusOf(done < 0 ? done : 0);
}

UsbStatus LibusbTransport::bulkOut(std::span<const std::uint8_t> bytes,
                                   unsigned timeout_ms) noexcept {
  std::size_t done = 0;
  // libusb takes one pointer for both directions; it does not write through it on the way out.
  auto* data = const_cast<std::uint8_t*>(bytes.data());
  const UsbStatus status = bulk(address_.endpoint_out, data, bytes.size(), done, timeout_ms);
  return status == UsbStatus::ok && done < bytes.size() ? UsbStatus::timeout : status;
}

UsbStatus LibusbTransport::bulkIn(std::span<std::uint8_t> into, std::size_t& got,
                                  unsigned timeout_ms) noexcept {
  const UsbStatus status = bulk(address_.endpoint_in, into.data(), into.size(), got, timeout_ms);
  return status == UsbStatus::timeout && got > 0 ? UsbStatus::ok : status;
}

UsbStatus LibusbTransport::bulk(std::uint8_t endpoint, std::uint8_t* bytes, std::size_t size,
                                std::size_t& done, unsigned timeout_ms) noexcept {
  done = 0;
  if (!handle_) return UsbStatus::gone;
  int moved = 0;
  const int error =
      libusb_bulk_transfer(handle_, endpoint, bytes, static_cast<int>(size), &moved, timeout_ms);
  if (error == LIBUSB_ERROR_PIPE) libusb_clear_halt(handle_, endpoint);
  done = static_cast<std::size_t>(moved);
  return statusOf(error);
}

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
