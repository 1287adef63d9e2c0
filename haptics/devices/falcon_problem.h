#pragma once

#include <cstdint>

#include "anatomy/geometry/error.h"
#include "haptics/devices/falcon_firmware.h"

namespace palpa::haptics {

/// Where the link with a Falcon stands.
enum class FalconState : std::uint8_t {
  closed,
  opening,    ///< not found yet, or not answering yet
  uploading,  ///< it is there and has no firmware
  homing,     ///< it answers; the grip has to be pulled out and pushed in once
  ready,      ///< positions are absolute, forces are rendered
  lost,       ///< it was there and is gone or silent; opened again as soon as it is back
};

/// What keeps it from going on.
enum class FalconProblem : std::uint8_t {
  none,
  absent,
  denied,
  busy,
  needs_firmware,  ///< it does not answer, and no firmware was given
  upload_failed,
  silent,  ///< it is plugged in and stopped answering
  usb,
};

FalconProblem problemOf(UsbStatus status);

/// The problem in words for the person at the station: what, where, what to do.
Error falconError(FalconProblem problem);

/// What the person has to do for the state to go on ("Pull the grip ..."); empty: nothing.
const char* falconInstruction(FalconState state);

}  // namespace palpa::haptics
