#include "haptics/devices/falcon/falcon_protocol.h"

#include <algorithm>
#include <array>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::haptics {
namespace {

constexpr std::uint8_t kFirstByte = 0x3C, kLastByte = 0x3E, kZeroByte = 0x41;
constexpr std::size_t kFlagsAt = 13;

void putNumber(FalconPacket& packet, std::size_t at, std::int16_t number) {
  const auto bits = static_cast<std::uint16_t>(number);
  for (std::size_t i = 0; i < 4; ++i)
    packet[at + i] = static_cast<std::uint8_t>(kZeroByte + ((bits >> (4 * i)) & 0xF));
}

std::int16_t numberAt(const FalconPacket& packet, std::size_t at) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < 4; ++i)
    bits |= static_cast<unsigned>(packet[at + i] - kZeroByte) << (4 * i);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

bool isReport(const FalconPacket& packet) {
  const auto is_nibble = [](std::uint8_t b) { return b >= kZeroByte && b < kZeroByte + 16; };
  return packet.front() == kFirstByte && packet.back() == kLastByte &&
         std::all_of(packet.begin() + 1, packet.begin() + kFlagsAt, is_nibble) &&
         packet[kFlagsAt] >= kZeroByte;
}

}  // namespace

FalconPacket encode(const FalconCommand& command) noexcept {
  FalconPacket packet;
  packet.fill(kZeroByte);
  packet.front() = kFirstByte;
  packet.back() = kLastByte;
  for (std::size_t leg = 0; leg < 3; ++leg) putNumber(packet, 1 + 4 * leg, command.motor[leg]);
  packet[kFlagsAt] = static_cast<std::uint8_t>(kZeroByte + (command.flags & 0xF));
  return packet;
}

std::optional<FalconReport> FalconParser::push(std::uint8_t byte) noexcept {
  bytes_[size_++] = byte;
  if (bytes_.front() != kFirstByte) dropToNextStart();
  if (size_ < kFalconPacketSize) return std::nullopt;
  if (!isReport(bytes_)) {
    dropToNextStart();
    return std::nullopt;
  }
  FalconReport report;
  for (std::size_t leg = 0; leg < 3; ++leg) report.encoder[leg] = numberAt(bytes_, 1 + 4 * leg);
  const int state = bytes_[kFlagsAt] - kZeroByte;
  report.buttons = static_cast<std::uint8_t>(state & 0xF);
  report.homed = static_cast<std::uint8_t>((state >> 4) & 7);
  size_ = 0;
  return report;
}

void FalconParser::forget() noexcept {
  skipped_ += size_;
  size_ = 0;
}

void FalconParser::dropToNextStart() noexcept {
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto start = std::find(bytes_.begin() + 1, end, kFirstByte);
  skipped_ += static_cast<std::uint64_t>(start - bytes_.begin());
  std::copy(start, end, bytes_.begin());
  size_ = static_cast<std::size_t>(end - start);
}

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

enum class AnswerPrefix { nothing, zeros };  // what may come before an answer

/// Sends and waits for `wanted` to come back. ok: it came; timeout: something else came, or not
/// enough.
UsbStatus ask(FtdiSerial& serial, UploadBytes sent, UploadBytes wanted, int patience,
              AnswerPrefix before = AnswerPrefix::nothing) {
  if (const UsbStatus status = serial.write(sent); status != UsbStatus::ok) return status;
  std::size_t matched = 0;
  for (int empty = 0; empty < patience;) {
    FtdiPayload payload;
    if (const UsbStatus status = serial.read(payload); status != UsbStatus::ok) return status;
    if (payload.size == 0) ++empty;
    for (const std::uint8_t byte : payload.view()) {
      if (matched == 0 && byte == 0 && before == AnswerPrefix::zeros) continue;
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
    status = ask(serial, kGreeting, kGreetingReply, kGreetingPatience, AnswerPrefix::zeros);
  return status;
}

FalconUploadResult failed(FalconUpload why, UsbStatus status) {
  return {status == UsbStatus::timeout ? why : FalconUpload::usb, status};
}

}  // namespace

std::vector<std::uint8_t> readFalconFirmware(const std::filesystem::path& path) {
  std::error_code nothing;
  std::optional<std::string> bytes;
  if (std::filesystem::is_regular_file(path, nothing)) bytes = readWhole(path);
  if (!bytes)
    throw Error("cannot be read", "the Falcon's firmware " + path.string(),
                "Give the path of a firmware file; it comes with Novint's drivers "
                "(nvent_firmware.bin) and is not part of Palpa.");
  std::vector<std::uint8_t> image(bytes->begin(), bytes->end());
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
