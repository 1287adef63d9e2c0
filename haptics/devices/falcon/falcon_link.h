#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "anatomy/base/error.h"
#include "haptics/devices/driver.h"
#include "haptics/devices/falcon/falcon_protocol.h"
#include "haptics/devices/usb_transport.h"

namespace palpa::haptics {

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
const char* falconInstruction(DriverState state);

/// The Falcon's FTDI chip, with the product number that Novint gave it.
inline constexpr UsbAddress kFalconUsb{0x0403, 0xCB48, 0x02, 0x81};

struct FalconStatus {
  DriverState state = DriverState::closed;
  FalconProblem problem = FalconProblem::none;
  std::uint64_t exchanges = 0;  ///< answered
  std::uint64_t missed = 0;     ///< packets without an answer, whatever the reason
  std::uint64_t stalls = 0, timeouts = 0;
  std::uint64_t skipped_bytes = 0;  ///< received, part of no report
  std::uint64_t opened = 0, uploads = 0;
};

/// The conversation with a Falcon, in counts:
///
///   closed -> opening -> [preparing ->] homing -> ready        (preparing: its firmware is
///   uploaded)
///                ^                        |         |
///               lost <------ unplugged or silent ---'   (opened again, ever more seldom to 2 s)
///
/// Every packet is one step: motor counts out, a report in. The motors get zero unless the last
/// packet was answered and all three legs are homed; the last packet before close() is zero. Until
/// homed every packet asks for homing and lights the red LED, then the green one.
///
/// Belongs to one thread, which may block in it: milliseconds an exchange, seconds an upload.
class FalconLink {
 public:
  static constexpr std::int64_t kNever = Driver::kNever;

  /// `firmware` empty: only a device with running firmware can be used.
  FalconLink(UsbTransport& usb, std::vector<std::uint8_t> firmware);
  ~FalconLink() { close(); }
  FalconLink(const FalconLink&) = delete;
  FalconLink& operator=(const FalconLink&) = delete;

  void open() noexcept;
  /// Does what is due at `now_ns`; says when it is due next. `motor` as in falconCounts().
  std::int64_t step(std::int64_t now_ns, const std::array<std::int16_t, 3>& motor) noexcept;
  void close() noexcept;

  /// What the last step heard; none when it heard nothing.
  const std::optional<FalconReport>& report() const { return report_; }
  const FalconStatus& status() const { return status_; }

 private:
  void connect(std::int64_t now_ns) noexcept;
  void upload(std::int64_t now_ns) noexcept;
  bool answers() noexcept;
  void exchange(std::int64_t now_ns, const std::array<std::int16_t, 3>& motor) noexcept;
  UsbStatus talk(const FalconCommand& command) noexcept;
  UsbStatus listen() noexcept;
  void miss(std::int64_t now_ns, UsbStatus status) noexcept;
  void giveUp(std::int64_t now_ns, FalconProblem problem) noexcept;
  bool talking() const;

  UsbTransport& usb_;
  FtdiSerial serial_;
  std::vector<std::uint8_t> firmware_;
  FalconParser parser_;
  FalconStatus status_;
  std::optional<FalconReport> report_;
  std::int64_t due_ns_ = 0, pause_ns_ = 0;
  int missed_in_a_row_ = 0;
  bool half_uploaded_ = false;  // what runs after a wrong echo is not trusted, even if it answers
};

}  // namespace palpa::haptics
