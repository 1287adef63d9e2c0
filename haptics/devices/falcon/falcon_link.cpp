#include "haptics/devices/falcon/falcon_link.h"

#include <algorithm>

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

const char* falconInstruction(DriverState state) {
  switch (state) {
    case DriverState::opening:
    case DriverState::lost:
      return "Plug in the Falcon's USB cable and power supply.";
    case DriverState::preparing:
      return "Wait: the Falcon receives its firmware.";
    case DriverState::homing:
      return "Pull the grip fully out, then push it fully in.";
    case DriverState::closed:
    case DriverState::ready:
      break;
  }
  return "";
}

namespace {

constexpr std::int64_t kExchangePeriod_ns = 1'000'000;
constexpr std::int64_t kFirstPause_ns = 50'000'000, kLongestPause_ns = 2'000'000'000;
constexpr int kProbes = 50;        // packets before a device counts as one without firmware
constexpr int kReads = 8;          // USB packets to wait for an answer; empty ones come each ms
constexpr int kMissesToLose = 50;  // answers missing in a row before it is opened again

FalconCommand homingCommand() { return {{}, kFalconHoming | kFalconRed}; }

}  // namespace

FalconLink::FalconLink(UsbTransport& usb, std::vector<std::uint8_t> firmware)
    : usb_(usb), serial_(usb), firmware_(std::move(firmware)) {}

void FalconLink::open() noexcept {
  if (status_.state != DriverState::closed) return;
  status_.state = DriverState::opening;
  status_.problem = FalconProblem::none;
  due_ns_ = 0;
  pause_ns_ = kFirstPause_ns;
}

std::int64_t FalconLink::step(std::int64_t now_ns,
                              const std::array<std::int16_t, 3>& motor) noexcept {
  report_.reset();
  if (status_.state == DriverState::closed) return kNever;
  if (now_ns < due_ns_) return due_ns_;
  switch (status_.state) {
    case DriverState::opening:
    case DriverState::lost:
      connect(now_ns);
      break;
    case DriverState::preparing:
      upload(now_ns);
      break;
    default:
      exchange(now_ns, motor);
  }
  status_.skipped_bytes = parser_.skipped();
  return due_ns_;
}

void FalconLink::close() noexcept {
  if (status_.state == DriverState::closed) return;
  if (talking() && serial_.write(encode({})) != UsbStatus::ok) serial_.write(encode({}));
  usb_.close();
  status_.state = DriverState::closed;
}

bool FalconLink::talking() const {
  return status_.state == DriverState::homing || status_.state == DriverState::ready;
}

void FalconLink::connect(std::int64_t now_ns) noexcept {
  UsbStatus status = usb_.open();
  if (status == UsbStatus::ok) status = setFalconNormalMode(serial_);
  if (status != UsbStatus::ok) return giveUp(now_ns, problemOf(status));
  ++status_.opened;
  due_ns_ = now_ns;  // go on at once
  if (!half_uploaded_ && answers()) {
    status_.state = DriverState::homing;
  } else if (firmware_.empty()) {
    giveUp(now_ns, FalconProblem::needs_firmware);
  } else {
    status_.state = DriverState::preparing;
  }
}

void FalconLink::upload(std::int64_t now_ns) noexcept {
  half_uploaded_ = true;
  FalconUploadResult result = uploadFalconFirmware(serial_, firmware_);
  if (result.outcome == FalconUpload::done) {
    half_uploaded_ = false;
    ++status_.uploads;
    result.usb = setFalconNormalMode(serial_);
    if (result.usb == UsbStatus::ok && answers()) {
      status_.state = DriverState::homing;
      due_ns_ = now_ns;
      return;
    }
  }
  const bool gone = result.usb == UsbStatus::gone;
  giveUp(now_ns, gone ? FalconProblem::absent : FalconProblem::upload_failed);
}

bool FalconLink::answers() noexcept {
  parser_.forget();
  for (int i = 0; i < kProbes; ++i) {
    const UsbStatus status = talk(homingCommand());
    if (status == UsbStatus::gone) return false;
    if (status != UsbStatus::ok) continue;
    missed_in_a_row_ = 0;
    pause_ns_ = kFirstPause_ns;
    status_.problem = FalconProblem::none;
    return true;
  }
  return false;
}

void FalconLink::exchange(std::int64_t now_ns, const std::array<std::int16_t, 3>& motor) noexcept {
  FalconCommand command = homingCommand();
  if (status_.state == DriverState::ready) {
    command.flags = kFalconGreen;
    if (missed_in_a_row_ == 0) command.motor = motor;
  }
  due_ns_ = now_ns + kExchangePeriod_ns;
  if (const UsbStatus status = talk(command); status != UsbStatus::ok) return miss(now_ns, status);
  ++status_.exchanges;
  missed_in_a_row_ = 0;
  status_.state = report_->allHomed() ? DriverState::ready : DriverState::homing;
}

/// One packet out, its answer into `report_`.
UsbStatus FalconLink::talk(const FalconCommand& command) noexcept {
  const UsbStatus status = serial_.write(encode(command));
  return status == UsbStatus::ok ? listen() : status;
}

UsbStatus FalconLink::listen() noexcept {
  for (int i = 0; i < kReads; ++i) {
    FtdiPayload payload;
    if (const UsbStatus status = serial_.read(payload); status != UsbStatus::ok) return status;
    for (const std::uint8_t byte : payload.view())
      if (const auto report = parser_.push(byte)) report_ = report;
    if (report_) return UsbStatus::ok;
  }
  return UsbStatus::timeout;
}

void FalconLink::miss(std::int64_t now_ns, UsbStatus status) noexcept {
  ++status_.missed;
  status_.stalls += status == UsbStatus::stall;
  status_.timeouts += status == UsbStatus::timeout;
  if (status == UsbStatus::gone) return giveUp(now_ns, FalconProblem::absent);
  if (++missed_in_a_row_ >= kMissesToLose) return giveUp(now_ns, FalconProblem::silent);
  // An answer that comes late would be taken for the next one's, and so on for ever.
  parser_.forget();
  if (serial_.purge() == UsbStatus::gone) giveUp(now_ns, FalconProblem::absent);
}

void FalconLink::giveUp(std::int64_t now_ns, FalconProblem problem) noexcept {
  usb_.close();
  status_.state =
      talking() || status_.state == DriverState::lost ? DriverState::lost : DriverState::opening;
  status_.problem = problem;
  due_ns_ = now_ns + pause_ns_;
  pause_ns_ = std::min(2 * pause_ns_, kLongestPause_ns);
}

}  // namespace palpa::haptics
