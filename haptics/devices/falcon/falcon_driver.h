#pragma once

#include <memory>
#include <vector>

#include "haptics/devices/driver.h"
#include "haptics/devices/falcon/falcon_kinematics.h"
#include "haptics/devices/falcon/falcon_link.h"
#include "haptics/latest_value.h"
#include "haptics/safety/safety_limiter.h"

namespace palpa::haptics {

/// 8 N and 3000 N/m as in CHAI3D's device table (the counts may end at 6.2 N across the axis, see
/// README); resolution from falconResolution(); the mass at the grip is not known (0). Workspace:
/// the cube of 8 cm about the centre, every corner of which is reached.
DeviceCapabilities falconCapabilities();

/// A Novint Falcon. A reading is stamped with the beginning of its exchange, when
/// the device looks at its encoders; its sequence grows only with a position that is known, or
/// before homing with each answer. A force is rendered while the command is younger than
/// `command_life_ns`.
class FalconDriver final : public Driver {
 public:
  /// `firmware` from readFalconFirmware(), or empty.
  FalconDriver(std::unique_ptr<UsbTransport> usb, std::vector<std::uint8_t> firmware,
               std::int64_t command_life_ns = SafetyLimits{}.watchdog_ns);

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  DeviceReading read(std::int64_t now_ns) noexcept override;
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override;

  void open() noexcept override { link_.open(); }
  std::int64_t step(std::int64_t now_ns) noexcept override;
  void close() noexcept override;
  DriverStatus status() noexcept override;
  std::string words(const DriverStatus& status) const override;

  FalconStatus details() noexcept { return statuses_.read(); }  ///< as status(), in full

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
