#pragma once

#include <cstdint>
#include <span>

/// A Falcon whose firmware runs, in the place of what libusb would find: while PALPA_FALCON names a
/// file. That file is its world: where the grip is, and what the motors do.
namespace palpa::test {

/// The file's bytes.
struct FalconWorld {
  std::int16_t encoder[3], motor[3];
  std::uint32_t packets;  ///< that the firmware has taken
};

bool hasFalcon() noexcept;
void falconControl(int request, int value);
void falconOut(std::span<const std::uint8_t> bytes);
/// How many bytes of a packet it gives.
int falconIn(std::span<std::uint8_t> into);

}  // namespace palpa::test
