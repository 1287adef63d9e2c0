#include "haptics/devices/falcon_problem.h"

namespace palpa::haptics {
namespace {

struct FalconWords {
  const char* what;
  const char* remedy;
};

FalconWords wordsFor(FalconProblem problem) {
  switch (problem) {
    case FalconProblem::none:
      return {"nothing is wrong", "Nothing needs to be done"};
    case FalconProblem::absent:
      return {"is not there", "Plug in its USB cable and its power supply."};
    case FalconProblem::denied:
      return {
          "may not be used by this user",
          "As root copy assets/udev/60-palpa-falcon.rules into /etc/udev/rules.d, run \"udevadm "
          "control --reload\", and plug the Falcon in again."};
    case FalconProblem::busy:
      return {"is in use by another program", "Close that program."};
    case FalconProblem::needs_firmware:
      return {"has no firmware (it forgets it when the power is off)",
              "Give the path of a firmware file; it comes with Novint's drivers and is not part of "
              "Palpa."};
    case FalconProblem::upload_failed:
      return {"did not take the firmware",
              "It is tried again. If that lasts: unplug its power supply and plug it in again, use "
              "another USB port, check the firmware file."};
    case FalconProblem::silent:
      return {"stopped answering",
              "It is opened again. If that lasts: unplug its power supply and plug it in again."};
    case FalconProblem::usb:
      break;
  }
  return {"does not work on this USB port",
          "It is tried again. If that lasts: use another cable or another USB port."};
}

}  // namespace

FalconProblem problemOf(UsbStatus status) {
  switch (status) {
    case UsbStatus::ok:
      return FalconProblem::none;
    case UsbStatus::gone:
      return FalconProblem::absent;
    case UsbStatus::denied:
      return FalconProblem::denied;
    case UsbStatus::busy:
      return FalconProblem::busy;
    case UsbStatus::timeout:
    case UsbStatus::stall:
    case UsbStatus::other:
      break;
  }
  return FalconProblem::usb;
}

Error falconError(FalconProblem problem) {
  const FalconWords words = wordsFor(problem);
  return {words.what, "the Novint Falcon", words.remedy};
}

const char* falconInstruction(FalconState state) {
  switch (state) {
    case FalconState::opening:
    case FalconState::lost:
      return "Plug in the Falcon's USB cable and power supply.";
    case FalconState::uploading:
      return "Wait: the Falcon receives its firmware.";
    case FalconState::homing:
      return "Pull the grip fully out, then push it fully in.";
    case FalconState::closed:
    case FalconState::ready:
      break;
  }
  return "";
}

}  // namespace palpa::haptics
