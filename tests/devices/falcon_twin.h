#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

/// A Falcon as it looks from the USB cable: chip, loader, firmware. Written from the device's side,
/// with its own reading and writing of bytes, so that it can judge the driver's.
namespace palpa::test {

using Bytes = std::vector<std::uint8_t>;

struct TwinCommand {
  std::array<std::int16_t, 3> motor{};
  std::uint8_t flags = 0;
  bool pushes() const { return motor[0] || motor[1] || motor[2]; }
};

struct TwinReply {
  std::array<std::int16_t, 3> encoder{};
  std::uint8_t buttons = 0, homed = 0;
};

inline void putWord(Bytes& bytes, std::int16_t word) {
  for (int shift = 0; shift < 16; shift += 4)
    bytes.push_back(
        static_cast<std::uint8_t>('A' + ((static_cast<std::uint16_t>(word) >> shift) & 15)));
}

inline Bytes frame(const std::array<std::int16_t, 3>& words, int flags) {
  Bytes bytes{'<'};
  for (const std::int16_t word : words) putWord(bytes, word);
  bytes.push_back(static_cast<std::uint8_t>('A' + flags));
  bytes.insert(bytes.end(), {'A', '>'});
  return bytes;
}

inline Bytes writeReply(const TwinReply& reply) {
  return frame(reply.encoder, reply.buttons + 16 * reply.homed);
}
inline Bytes writeCommand(const TwinCommand& command) {
  return frame(command.motor, command.flags);
}

/// None unless every byte is as it must be.
inline std::optional<TwinCommand> readCommand(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != 16) return std::nullopt;
  TwinCommand command;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    int word = 0;
    for (std::size_t i = 0; i < 4; ++i) word += (bytes[1 + 4 * leg + i] - 'A') << (4 * i);
    command.motor[leg] = static_cast<std::int16_t>(word);
  }
  command.flags = static_cast<std::uint8_t>(bytes[13] - 'A');
  const Bytes again = writeCommand(command);
  if (command.flags > 15 || !std::equal(again.begin(), again.end(), bytes.begin()))
    return std::nullopt;
  return command;
}

/// Lock `mutex` before touching it: the other end may be another thread.
class FalconTwin {
 public:
  explicit FalconTwin(Bytes genuine_image) : genuine_(std::move(genuine_image)) {}

  std::mutex mutex;

  // How it behaves.
  TwinReply reply;          ///< what it answers; the homed bits are its own
  int homing_packets = 30;  ///< with the homing bit, until the legs are homed
  int deaf_greetings = 2;   ///< the first ones after a reset are not heard
  bool zero_before_greeting = false;
  int corrupt_chunk = -1;         ///< echo of this chunk of the next upload is wrong
  std::size_t cut_reply_at = 16;  ///< a reply goes out in two USB packets
  bool mute = false;              ///< the firmware does not answer

  // What it has seen.
  std::vector<TwinCommand> commands;  ///< with running firmware
  int malformed = 0;                  ///< packets that no firmware would take
  Bytes image;                        ///< of the last upload
  int resets = 0, chunks = 0;
  std::size_t largest_chunk = 0;
  int latency_ms = 0;

  bool running() const { return running_; }
  void startFirmware() { running_ = true; }
  void powerOff() {
    running_ = loading_ = false;
    homing_seen_ = 0;
    reply.homed = 0;
    queue_.clear();
  }
  /// The grip has been let go of its stops: as after a brown-out.
  void loseHoming() {
    reply.homed = 0;
    homing_seen_ = 0;
  }

  void control(int request, int value) {
    if (request == 0 && value == 1) queue_.clear();
    if (request == 1 && value == 0x0100) dtr_ = false;
    if (request == 1 && value == 0x0101) {
      if (!dtr_) reset();
      dtr_ = true;
    }
    if (request == 3) setBaud(value);
    if (request == 9) latency_ms = value;
  }

  void out(std::span<const std::uint8_t> bytes) {
    if (baud_ == 0x4138) return greeted(bytes);
    if (baud_ == 0x0015) return load(bytes);
    if (baud_ == 0x0002 && running_) return obey(bytes);
  }

  /// The next IN packet: two status bytes and up to 62 others.
  Bytes in() {
    Bytes packet{0x01, 0x60};
    if (queue_.empty()) return packet;
    packet.insert(packet.end(), queue_.front().begin(), queue_.front().end());
    queue_.pop_front();
    return packet;
  }

 private:
  void reset() {
    powerOff();
    image.clear();
    chunks = 0;
    greetings_ = 0;
    ++resets;
  }
  void setBaud(int divisor) {
    baud_ = divisor;
    if (baud_ == 0x0002 && loading_) {
      loading_ = false;
      running_ = image == genuine_;
    }
  }
  void greeted(std::span<const std::uint8_t> bytes) {
    if (!std::ranges::equal(bytes, Bytes{0x0A, 0x43, 0x0D})) return;
    if (greetings_++ < deaf_greetings) return;
    queue_.push_back(zero_before_greeting ? Bytes{0, 0x0A, 0x44, 0x2C, 0x0D}
                                          : Bytes{0x0A, 0x44, 0x2C, 0x0D});
  }
  void load(std::span<const std::uint8_t> bytes) {
    Bytes echo(bytes.begin(), bytes.end());
    if (!loading_) {
      if (dtr_ || echo != Bytes{0x41}) return;
      loading_ = true;
    } else {
      largest_chunk = std::max(largest_chunk, bytes.size());
      image.insert(image.end(), bytes.begin(), bytes.end());
      if (chunks++ == corrupt_chunk) {
        echo[echo.size() / 2] ^= 0x10;
        corrupt_chunk = -1;
      }
    }
    queue_.push_back(echo);
  }
  void obey(std::span<const std::uint8_t> bytes) {
    const auto command = readCommand(bytes);
    if (!command) {
      ++malformed;
      return;
    }
    commands.push_back(*command);
    if (command->flags & 1 && ++homing_seen_ >= homing_packets) reply.homed = 7;
    if (mute) return;
    const Bytes whole = writeReply(reply);
    const auto cut = whole.begin() + static_cast<std::ptrdiff_t>(cut_reply_at);
    queue_.emplace_back(whole.begin(), cut);
    if (cut != whole.end()) queue_.emplace_back(cut, whole.end());
  }

  Bytes genuine_;
  std::deque<Bytes> queue_;
  bool running_ = false, loading_ = false, dtr_ = true;
  int baud_ = 0, greetings_ = 0, homing_seen_ = 0;
};

}  // namespace palpa::test
