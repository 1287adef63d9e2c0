#include "haptics/devices/falcon/falcon_driver.h"

namespace palpa::haptics {

DeviceCapabilities falconCapabilities() {
  DeviceCapabilities falcon;
  falcon.name = "Novint Falcon";
  falcon.max_force_N =
      6.2;  // in every direction at the centre; the published 8 N and more along the axis only
  falcon.stable_stiffness = 3000;
  falcon.position_resolution = falconResolution();
  falcon.delay = 1e-3;  // one exchange on the cable
  falcon.force_axes = 3;
  falcon.has_orientation = false;
  falcon.workspace_centre = pack(kFalconCentre);
  falcon.workspace_half_size = {0.04, 0.04, 0.04};
  falcon.watchdog = Watchdog::unknown;  // what its motors do without packets is not documented
  return falcon;
}

FalconDriver::FalconDriver(std::unique_ptr<UsbTransport> usb, std::vector<std::uint8_t> firmware,
                           std::int64_t command_life_ns)
    : command_life_ns_(command_life_ns), usb_(std::move(usb)), link_(*usb_, std::move(firmware)) {}

DeviceReading FalconDriver::read(std::int64_t) noexcept { return readings_.read(); }

void FalconDriver::command(std::int64_t now_ns, const Packed3& f_D) noexcept {
  commands_.write({now_ns, f_D});
}

std::int64_t FalconDriver::step(std::int64_t now_ns) noexcept {
  const std::int64_t due_ns = link_.step(now_ns, motorCounts(now_ns));
  if (link_.status().state != DriverState::ready) pose_.reset();
  if (link_.report()) take(now_ns, *link_.report());
  publish();
  return due_ns;
}

void FalconDriver::close() noexcept {
  link_.close();
  pose_.reset();
  publish();
}

DriverStatus FalconDriver::status() noexcept {
  const FalconStatus all = statuses_.read();
  return {all.state, static_cast<std::uint8_t>(all.problem), all.exchanges, all.missed, all.opened};
}

std::string FalconDriver::words(const DriverStatus& status) const {
  if (status.state == DriverState::ready) return "";
  if (status.problem != 0) return falconError(static_cast<FalconProblem>(status.problem)).what();
  return falconInstruction(status.state);
}

std::array<std::int16_t, 3> FalconDriver::motorCounts(std::int64_t now_ns) noexcept {
  const ForceCommand& command = commands_.read();
  if (!pose_ || now_ns - command.t_ns > command_life_ns_) return {};
  return falconCounts(falconTorque(pose_->legs, unpack(command.f_D)));
}

void FalconDriver::take(std::int64_t now_ns, const FalconReport& report) noexcept {
  reading_.buttons = report.buttons;
  if (report.allHomed()) {
    const Vec3 theta1 = falconAngles(report.encoder);
    if (pose_) pose_ = falconForward(theta1, pose_->p_DE);
    if (!pose_) pose_ = falconForward(theta1, kFalconCentre);
    if (!pose_) return;  // angles that no position has: as if nothing had been heard
    reading_.p_DE = pack(pose_->p_DE);
  }
  reading_.t_ns = now_ns;
  ++reading_.sequence;
}

void FalconDriver::publish() noexcept {
  reading_.homed = pose_.has_value();
  readings_.write(reading_);
  statuses_.write(link_.status());
}

}  // namespace palpa::haptics
