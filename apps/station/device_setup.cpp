#include "apps/station/device_setup.h"

#include <numbers>

#include "haptics/devices/falcon_driver.h"

namespace palpa::station {
namespace {

constexpr double kToMetres = 1e-3;

/// What a maker or a measurement says of the mechanism.
void readMechanism(const JsonFile& file, haptics::DeviceCapabilities& device) {
  device.apparent_mass = file.number("device/apparent_mass_kg", 0, 5);
  device.viscous_damping = file.number("device/viscous_Ns_per_m", 0, 50);
  device.coulomb_friction = file.number("device/coulomb_N", 0, 5);
}

void readAll(const JsonFile& file, haptics::DeviceCapabilities& device) {
  device.name = file.text("device/name");
  device.max_force_N = file.number("device/max_force_N", 0.1, 100);
  device.stable_stiffness = file.number("device/stable_stiffness_N_per_m", 50, 50'000);
  device.position_resolution = kToMetres * file.number("device/position_resolution_mm", 0, 1);
  readMechanism(file, device);
}

std::uint32_t readButton(const JsonFile& file, const std::string& at) {
  return file.has(at) ? 1u << file.integer(at, 0, 31) : 0;
}

DeviceDriver readDriver(const JsonFile& file) {
  const std::string name = file.text("device/driver");
  if (name == "virtual") return DeviceDriver::bench;
  if (name == "falcon") return DeviceDriver::falcon;
  if (name == "mouse") return DeviceDriver::mouse;
  if (name == "replay") return DeviceDriver::replay;
  file.refuse("device/driver", "is \"" + name + "\"; known: virtual, falcon, mouse, replay");
}

Packed3 readPacked(const JsonFile& file, const std::string& at, double unit) {
  return pack(Vec3(unit * file.vector(at)));
}

void readNetFt(const JsonFile& file, haptics::NetFtSettings& net_ft) {
  net_ft.address = file.text("force_sensor/address");
  if (file.has("force_sensor/port"))
    net_ft.port = static_cast<std::uint16_t>(file.integer("force_sensor/port", 1, 65'535));
  if (file.has("force_sensor/start_code"))
    net_ft.start_code =
        static_cast<std::uint16_t>(file.integer("force_sensor/start_code", 1, 65'535));
  net_ft.scale.counts_per_N = file.number("force_sensor/counts_per_N", 1, 1e9);
  net_ft.scale.counts_per_Nm = file.number("force_sensor/counts_per_Nm", 1, 1e9);
}

}  // namespace

Pose readPose(const JsonFile& file, const std::string& at) {
  const Vec3 turn = file.vector(at + "/rotation_vector_deg") * (std::numbers::pi / 180);
  const double angle = turn.norm();
  const Mat3 R =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3::Identity();
  return makePose(R, kToMetres * file.vector(at + "/position_mm"));
}

DeviceSetup readDevice(const JsonFile& file, const std::filesystem::path& folder) {
  DeviceSetup device;
  device.driver = readDriver(file);
  if (device.driver == DeviceDriver::falcon) {
    device.capabilities = haptics::falconCapabilities();
    readMechanism(file, device.capabilities);
    if (file.has("device/firmware")) device.firmware = folder / file.text("device/firmware");
  } else {
    readAll(file, device.capabilities);
  }
  if (device.driver == DeviceDriver::replay)
    device.recording = folder / file.text("device/recording");
  device.capabilities.simulated = device.driver == DeviceDriver::bench;
  if (file.has("device/continuous_force_N")) {
    device.continuous_force_N =
        file.number("device/continuous_force_N", 0.05, device.capabilities.max_force_N);
    device.thermal_tau = file.number("device/thermal_tau_s", 0.1, 3600);
  }
  device.plunger_button = readButton(file, "device/plunger_button");
  return device;
}

std::optional<ForceSensorSetup> readForceSensor(const JsonFile& file) {
  if (!file.has("force_sensor")) return std::nullopt;
  ForceSensorSetup sensor;
  haptics::ForceSensorCapabilities& can = sensor.net_ft.capabilities;
  const std::string driver = file.text("force_sensor/driver");
  if (driver == "net_ft") {
    sensor.driver = ForceSensorSetup::Driver::net_ft;
    readNetFt(file, sensor.net_ft);
  } else if (driver != "virtual") {
    file.refuse("force_sensor/driver", "is \"" + driver + "\"; known: virtual, net_ft");
  }
  can.name = file.text("force_sensor/name");
  can.max_force_N = readPacked(file, "force_sensor/max_force_N", 1);
  can.simulated = sensor.driver == ForceSensorSetup::Driver::bench;
  sensor.X_ES = readPose(file, "force_sensor/X_ES");
  sensor.cutoff_Hz = file.number("force_sensor/cutoff_Hz", 1, 400);
  sensor.filter.tool.mass = 1e-3 * file.number("force_sensor/tool/mass_g", 0, 5000);
  sensor.filter.tool.p_SM = readPacked(file, "force_sensor/tool/centre_mm", kToMetres);
  sensor.filter.bias.f_S = readPacked(file, "force_sensor/bias/force_N", 1);
  sensor.filter.bias.tau_S = readPacked(file, "force_sensor/bias/torque_Nm", 1);
  return sensor;
}

}  // namespace palpa::station
