#include "haptics/devices/falcon_packet.h"

#include <algorithm>

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

}  // namespace palpa::haptics
