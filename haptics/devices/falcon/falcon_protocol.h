#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "haptics/devices/usb_transport.h"

/// The packets of a Novint Falcon with running firmware: the host sends one, the device answers
/// with one, 16 bytes each way. Byte 0 is '<', byte 15 is '>'; bytes 1..14 carry 0x41 + value.
/// Three signed 16-bit numbers stand in bytes 1..12, a nibble a byte, the low nibble first. Source
/// of the layout: libnifalcon (BSD-3), FalconFirmwareNovintSDK.
namespace palpa::haptics {

inline constexpr std::size_t kFalconPacketSize = 16;
using FalconPacket = std::array<std::uint8_t, kFalconPacketSize>;

/// Flags of a command, byte 13.
enum FalconFlag : std::uint8_t {
  kFalconHoming = 1u << 0,  ///< the device looks for the ends of its travel
  kFalconGreen = 1u << 1,
  kFalconBlue = 1u << 2,
  kFalconRed = 1u << 3,
};

/// Host to device.
struct FalconCommand {
  std::array<std::int16_t, 3> motor{};  ///< counts, see falconCounts()
  std::uint8_t flags = 0;               ///< FalconFlag bits
};

/// Device to host.
struct FalconReport {
  std::array<std::int16_t, 3> encoder{};  ///< counts, see falconAngles()
  std::uint8_t buttons = 0;               ///< 1 plus, 2 forward, 4 centre, 8 minus
  std::uint8_t homed = 0;                 ///< bit i: leg i has found its zero
  bool allHomed() const { return homed == 7; }
};

FalconPacket encode(const FalconCommand& command) noexcept;

/// Finds reports in a stream of bytes that may be split, torn or mixed with others. Any bytes do:
/// what does not belong to a report is skipped and counted. None of the values of a packet looks
/// like '<' or
/// '>', therefore the first whole packet after garbage is found.
class FalconParser {
 public:
  /// A report when `byte` completes one.
  std::optional<FalconReport> push(std::uint8_t byte) noexcept;
  std::uint64_t skipped() const { return skipped_; }  ///< bytes, since the beginning
  void forget() noexcept;                             ///< a packet begun will not be finished

 private:
  void dropToNextStart() noexcept;
  FalconPacket bytes_{};
  std::size_t size_ = 0;
  std::uint64_t skipped_ = 0;
};

}  // namespace palpa::haptics

/// The Falcon's firmware lives in memory that forgets: it is uploaded once after each power-up. The
/// image belongs to Novint and is not free: it is never part of this project, the user gives a file
/// (it comes with Novint's drivers; the one in common use, nvent_firmware.bin, has 8,492 bytes).
namespace palpa::haptics {

/// Reads an image. Throws palpa::Error when it is missing or no firmware by its size.
std::vector<std::uint8_t> readFalconFirmware(const std::filesystem::path& path);

enum class FalconUpload : std::uint8_t {
  done,
  no_loader,   ///< the microcontroller did not answer the greeting
  wrong_echo,  ///< a chunk came back otherwise than it was sent, or not at all
  usb,         ///< a request failed; `usb` says how
};

struct FalconUploadResult {
  FalconUpload outcome = FalconUpload::done;
  UsbStatus usb = UsbStatus::ok;
};

/// One try: resets the microcontroller into its loader, greets it, sends the image in chunks of at
/// most 62 bytes each of which must come back as it went (the only check there is). Blocks for
/// seconds.
FalconUploadResult uploadFalconFirmware(FtdiSerial& serial,
                                        std::span<const std::uint8_t> image) noexcept;

/// The line as the running firmware wants it: 1 ms latency, full speed, nothing waiting.
UsbStatus setFalconNormalMode(FtdiSerial& serial) noexcept;

}  // namespace palpa::haptics
