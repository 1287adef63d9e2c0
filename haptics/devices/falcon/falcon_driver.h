#pragma once

#include <memory>
#include <vector>

#include "haptics/device.h"
#include "haptics/devices/falcon/falcon_kinematics.h"
#include "haptics/devices/falcon/falcon_link.h"
#include "haptics/latest_value.h"
#include "haptics/safety/safety_limiter.h"

namespace palpa::haptics {

/// 8 N and 3000 N/m as in CHAI3D's device table (the counts may end at 6.2 N across the axis, see
/// README); resolution from falconResolution(); the mass at the grip is not known (0). Workspace:
/// the cube of 8 cm about the centre, every corner of which is reached.
DeviceCapabilities falconCapabilities();

/// A Novint Falcon as the haptic loop sees it. Three threads may hold it:
///   haptic   read() and command() exchange latest values; they never wait, allocate or throw
///   device   open(), then step() whenever it is due, then close()
///   watcher  status(), one thread
/// All of them count the same time. A reading is stamped with the beginning of its exchange, when
/// the device looks at its encoders; its sequence grows only with a position that is known, or
/// before homing with each answer. A force is rendered while the command is younger than
/// `command_life_ns`.
class FalconDriver final : public HapticDevice {
 public:
  /// `firmware` from readFalconFirmware(), or empty.
  FalconDriver(std::unique_ptr<UsbTransport> usb, std::vector<std::uint8_t> firmware,
               std::int64_t command_life_ns = SafetyLimits{}.watchdog_ns);

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  DeviceReading read(std::int64_t now_ns) noexcept override;
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override;

  void open() noexcept { link_.open(); }
  /// One exchange, or whatever else is due; returns when the next is due (FalconLink::kNever:
  /// closed).
  std::int64_t step(std::int64_t now_ns) noexcept;
  void close() noexcept;

  FalconStatus status() noexcept { return statuses_.read(); }

 private:
  struct ForceCommand {
    std::int64_t t_ns = 0;
    Packed3 f_D{0, 0, 0};
  };
  std::array<std::int16_t, 3> motorCounts(std::int64_t now_ns) noexcept;
  void take(std::int64_t now_ns, const FalconReport& report) noexcept;
  void publish() noexcept;

  DeviceCapabilities capabilities_ = falconCapabilities();
  const std::int64_t command_life_ns_;
  std::unique_ptr<UsbTransport> usb_;
  FalconLink link_;
  std::optional<FalconPose> pose_;  // of the last exchange; none: no force
  DeviceReading reading_;
  LatestValue<DeviceReading> readings_;
  LatestValue<ForceCommand> commands_;
  LatestValue<FalconStatus> statuses_;
};

}  // namespace palpa::haptics
