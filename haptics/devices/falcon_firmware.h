#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "haptics/devices/ftdi_serial.h"

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
