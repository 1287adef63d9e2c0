#include "haptics/devices/falcon_firmware.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "anatomy/geometry/error.h"

namespace palpa::haptics {
namespace {

constexpr std::size_t kSmallestImage = 6'000, kLargestImage = 12'000;  // known ones: 7,324 to 8,492
constexpr std::size_t kChunk = 62;  // fits one USB packet beside the two status bytes
constexpr std::uint16_t kBaud9600 = 0x4138, kBaudUpload = 0x0015, kBaudNormal = 0x0002;
constexpr int kGreetings = 100, kGreetingPatience = 3,
              kEchoPatience = 6;  // empty packets, 16 ms each
constexpr std::array<std::uint8_t, 3> kGreeting{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kGreetingReply{0x0A, 0x44, 0x2C, 0x0D};
constexpr std::array<std::uint8_t, 1> kBegin{0x41};

using UploadBytes = std::span<const std::uint8_t>;

/// The first failure of a row of requests; those after it are not made.
class Requests {
 public:
  template <class Request>
  Requests& then(Request&& request) {
    if (status_ == UsbStatus::ok) status_ = request();
    return *this;
  }
  UsbStatus status() const { return status_; }

 private:
  UsbStatus status_ = UsbStatus::ok;
};

UsbStatus setLoaderMode(FtdiSerial& serial) {
  return Requests()
      .then([&] { return serial.purge(); })
      .then([&] { return serial.latency(16); })
      .then([&] { return serial.baudDivisor(kBaud9600); })
      .then([&] { return serial.eightBitsNoFlowControl(); })
      .then([&] { return serial.rts(false); })
      .then([&] { return serial.dtr(false); })
      .then([&] { return serial.dtr(true); })  // this edge resets the microcontroller
      .status();
}

enum class Before { nothing, zeros };  // what may come before an answer

/// Sends and waits for `wanted` to come back. ok: it came; timeout: something else came, or not
/// enough.
UsbStatus ask(FtdiSerial& serial, UploadBytes sent, UploadBytes wanted, int patience,
              Before before = Before::nothing) {
  if (const UsbStatus status = serial.write(sent); status != UsbStatus::ok) return status;
  std::size_t matched = 0;
  for (int empty = 0; empty < patience;) {
    FtdiPayload payload;
    if (const UsbStatus status = serial.read(payload); status != UsbStatus::ok) return status;
    if (payload.size == 0) ++empty;
    for (const std::uint8_t byte : payload.view()) {
      if (matched == 0 && byte == 0 && before == Before::zeros) continue;
      if (matched == wanted.size() || byte != wanted[matched]) return UsbStatus::timeout;
      ++matched;
    }
    if (matched == wanted.size()) return UsbStatus::ok;
  }
  return UsbStatus::timeout;
}

UsbStatus greet(FtdiSerial& serial) {
  UsbStatus status = UsbStatus::timeout;
  for (int i = 0; i < kGreetings && status == UsbStatus::timeout; ++i)
    status = ask(serial, kGreeting, kGreetingReply, kGreetingPatience, Before::zeros);
  return status;
}

FalconUploadResult failed(FalconUpload why, UsbStatus status) {
  return {status == UsbStatus::timeout ? why : FalconUpload::usb, status};
}

}  // namespace

std::vector<std::uint8_t> readFalconFirmware(const std::filesystem::path& path) {
  std::error_code nothing;
  std::ifstream file(path, std::ios::binary);
  if (!file || !std::filesystem::is_regular_file(path, nothing))
    throw Error("cannot be read", "the Falcon's firmware " + path.string(),
                "Give the path of a firmware file; it comes with Novint's drivers "
                "(nvent_firmware.bin) and is not part of Palpa.");
  std::vector<std::uint8_t> image{std::istreambuf_iterator<char>(file), {}};
  if (image.size() < kSmallestImage || image.size() > kLargestImage)
    throw Error("has " + std::to_string(image.size()) + " bytes; firmware has 6,000 to 12,000",
                "the Falcon's firmware " + path.string(),
                "Give the path of a firmware file: nvent_firmware.bin has 8,492 bytes.");
  return image;
}

FalconUploadResult uploadFalconFirmware(FtdiSerial& serial, UploadBytes image) noexcept {
  const UsbStatus ready = Requests()
                              .then([&] { return setLoaderMode(serial); })
                              .then([&] { return greet(serial); })
                              .then([&] { return serial.dtr(false); })
                              .then([&] { return serial.baudDivisor(kBaudUpload); })
                              .then([&] { return ask(serial, kBegin, kBegin, kEchoPatience); })
                              .status();
  if (ready != UsbStatus::ok) return failed(FalconUpload::no_loader, ready);
  while (!image.empty()) {
    const UploadBytes chunk = image.first(std::min(kChunk, image.size()));
    const UsbStatus echo = ask(serial, chunk, chunk, kEchoPatience);
    if (echo != UsbStatus::ok) return failed(FalconUpload::wrong_echo, echo);
    image = image.subspan(chunk.size());
  }
  return {};
}

UsbStatus setFalconNormalMode(FtdiSerial& serial) noexcept {
  return Requests()
      .then([&] { return serial.purge(); })
      .then([&] { return serial.latency(1); })
      .then([&] { return serial.baudDivisor(kBaudNormal); })
      .then([&] { return serial.purge(); })
      .status();
}

}  // namespace palpa::haptics
