#include "apps/station/station_sections.h"

#include <algorithm>
#include <numbers>

#include "anatomy/base/enum_names.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/nearest_word.h"
#include "anatomy/base/units.h"
#include "anatomy/geometry/pose.h"

namespace palpa::station {
namespace {

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
  device.position_resolution = kMm * file.number("device/position_resolution_mm", 0, 1);
  readMechanism(file, device);
}

std::uint32_t readButton(const JsonFile& file, const std::string& at) {
  return file.has(at) ? 1u << file.integer(at, 0, 31) : 0;
}

/// The last three of DeviceDriver are nobody's; in place of "real" stand the names of drivers.
void readDriver(const JsonFile& file, DeviceSetup& device) {
  const std::string name = file.text("device/driver");
  device.real = haptics::driverNamed(name);
  if (device.real)
    device.driver = DeviceDriver::real;
  else if (name == "mouse")
    device.driver = DeviceDriver::mouse;
  else if (name == "replay")
    device.driver = DeviceDriver::replay;
  else if (name != "virtual") {
    std::string known = "virtual, ";
    for (const haptics::DriverDescription* one : haptics::drivers()) known += one->name + ", ";
    file.refuse("device/driver", "is \"" + name + "\"; known: " + known + "mouse, replay");
  }
}

bool isRemark(const std::string& field) {
  return field.ends_with("about") || field.ends_with("source");
}

/// The fields that the driver declares, and no others beside those that every device has.
void readSettings(const JsonFile& file, const std::filesystem::path& folder, DeviceSetup& device) {
  static const std::vector<haptics::DriverField> none;
  const std::vector<haptics::DriverField>& fields = device.real ? device.real->fields : none;
  std::vector<std::string> known = fieldsOf("station", "device");
  for (const haptics::DriverField& field : fields) known.push_back(field.name);
  for (const auto& [name, value] : file.json().at("device").items())
    if (!isRemark(name) && std::find(known.begin(), known.end(), name) == known.end())
      file.refuse("device/" + name, "is unknown" + didYouMean(name, known));
  for (const haptics::DriverField& field : fields) {
    using Kind = haptics::DriverField::Kind;
    const std::string at = "device/" + field.name;
    if (!file.has(at)) continue;
    if (field.kind == Kind::text)
      device.settings.set(field.name, file.text(at));
    else if (field.kind == Kind::file)
      device.settings.set(field.name, (folder / file.text(at)).string());
    else if (field.kind == Kind::whole)
      device.settings.set(field.name, double{0} + file.integer(at, static_cast<int>(field.least),
                                                               static_cast<int>(field.most)));
    else
      device.settings.set(field.name, file.number(at, field.least, field.most));
  }
}

const EnumNames<ForceSensorDriver> kForceSensorDrivers{"virtual", "net_ft"};

Packed3 readPacked(const JsonFile& file, const std::string& at, double unit) {
  return pack(Vec3(unit * unpack(file.triple(at))));
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
  const Vec3 turn = unpack(file.triple(at + "/rotation_vector_deg")) * (std::numbers::pi / 180);
  const double angle = turn.norm();
  const Mat3 R =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3::Identity();
  return makePose(R, kMm * unpack(file.triple(at + "/position_mm")));
}

DeviceSetup readDevice(const JsonFile& file, const std::filesystem::path& folder) {
  DeviceSetup device;
  readDriver(file, device);
  readSettings(file, folder, device);
  if (device.real) {
    device.capabilities = device.real->capabilities(device.settings);
    readMechanism(file, device.capabilities);
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
  if (file.has("device/angle_resolution_deg"))
    device.angle_resolution =
        file.number("device/angle_resolution_deg", 0, 5) * (std::numbers::pi / 180);
  device.plunger_button = readButton(file, "device/plunger_button");
  return device;
}

std::optional<ForceSensorSetup> readForceSensor(const JsonFile& file) {
  if (!file.has("force_sensor")) return std::nullopt;
  ForceSensorSetup sensor;
  haptics::ForceSensorCapabilities& can = sensor.net_ft.capabilities;
  sensor.driver = kForceSensorDrivers.in(file, "force_sensor/driver");
  if (sensor.driver == ForceSensorDriver::net_ft) readNetFt(file, sensor.net_ft);
  can.name = file.text("force_sensor/name");
  can.max_force_N = readPacked(file, "force_sensor/max_force_N", 1);
  can.simulated = sensor.driver == ForceSensorDriver::bench;
  sensor.X_ES = readPose(file, "force_sensor/X_ES");
  if (file.has("force_sensor/noise_N")) {
    if (file.has("force_sensor/cutoff_Hz"))
      file.refuse("force_sensor/cutoff_Hz",
                  "is of a low-pass, but noise_N asks for a Kalman filter: state one of the two");
    sensor.noise_N = file.number("force_sensor/noise_N", 1e-4, 1);
  } else {
    if (!file.has("force_sensor/cutoff_Hz"))
      file.refuse("force_sensor/noise_N", "is missing, and so is cutoff_Hz: state one of the two");
    sensor.cutoff_Hz = file.number("force_sensor/cutoff_Hz", 1, 400);
  }
  sensor.tool.mass = 1e-3 * file.number("force_sensor/tool/mass_g", 0, 5000);
  sensor.tool.p_SM = readPacked(file, "force_sensor/tool/centre_mm", kMm);
  sensor.bias.f_S = readPacked(file, "force_sensor/bias/force_N", 1);
  sensor.bias.tau_S = readPacked(file, "force_sensor/bias/torque_Nm", 1);
  return sensor;
}

std::optional<TrackerSetup> readTracker(const JsonFile& file) {
  if (!file.has("tracker")) return std::nullopt;
  if (const std::string driver = file.text("tracker/driver"); driver != "plus")
    file.refuse("tracker/driver", "is \"" + driver + "\"; known: plus");
  TrackerSetup tracker;
  tracker.transform = file.text("tracker/transform");
  if (const std::size_t to = tracker.transform.find("To");
      to == 0 || to == std::string::npos || to + 2 == tracker.transform.size())
    file.refuse("tracker/transform",
                "is \"" + tracker.transform +
                    "\": a name such as ReferenceToCamera states which pose it is");
  if (file.has("tracker/host")) tracker.host = file.text("tracker/host");
  if (file.has("tracker/port"))
    tracker.port = static_cast<std::uint16_t>(file.integer("tracker/port", 1, 65'535));
  tracker.X_CK = readPose(file, "tracker/X_CK");
  tracker.X_RW = readPose(file, "tracker/X_RW");
  if (file.has("tracker/latency_ms"))
    tracker.latency_s = 1e-3 * file.number("tracker/latency_ms", 0, 500);
  if (file.has("tracker/stale_ms"))
    tracker.stale_s = 1e-3 * file.number("tracker/stale_ms", 10, 1000);
  if (file.has("tracker/sigma_mm"))
    tracker.sigma = 1e-3 * file.number("tracker/sigma_mm", 0.01, 10);
  if (file.has("tracker/sigma_deg"))
    tracker.sigma_rad = file.number("tracker/sigma_deg", 0.005, 5) * (std::numbers::pi / 180);
  if (file.has("tracker/ask_tdata_ms"))
    tracker.ask_tdata_ms = file.integer("tracker/ask_tdata_ms", 1, 1000);
  return tracker;
}

namespace {

bool shareTags(const ar::TagGridSpec& a, const ar::TagGridSpec& b) {
  return a.first_id < b.first_id + b.columns * b.rows &&
         b.first_id < a.first_id + a.columns * a.rows;
}

double unitOf(const JsonFile& entry) {
  const std::string unit = entry.text("unit");
  if (unit == "m") return 1;
  if (unit == "cm") return 1e-2;
  if (unit == "mm") return kMm;
  entry.refuse("unit", "is \"" + unit + "\"; known are m, cm, mm");
}

}  // namespace

ar::TagGridSpec readBoard(const JsonFile& file, const std::string& at) {
  ar::TagGridSpec board;
  board.columns = file.integer(at + "/columns", 1, 30);
  board.rows = file.integer(at + "/rows", 1, 30);
  board.tag_size = kMm * file.number(at + "/tag_size_mm", 2, 500);
  board.spacing = kMm * file.number(at + "/spacing_mm", 0.5, 500);
  board.first_id = file.integer(at + "/first_id", 0, 586);
  ar::validate(board, file.name() + ", \"" + at + "\"");
  return board;
}

std::vector<OtherBoard> readOtherBoards(const JsonFile& file,
                                        const std::vector<ar::TagGridSpec>& others) {
  std::vector<OtherBoard> boards;
  std::vector<ar::TagGridSpec> known = others;
  for (const JsonFile& entry : file.entries("boards")) {
    OtherBoard board;
    board.name = entry.text("name");
    board.grid = readBoard(entry, "");
    if (entry.has("X_WB")) board.X_WB = readPose(entry, "X_WB");
    if (entry.has("tolerance_mm")) board.tolerance = kMm * entry.number("tolerance_mm", 1, 100);
    const bool taken = board.name == "table" || board.name == "tool" ||
                       std::any_of(boards.begin(), boards.end(),
                                   [&](const OtherBoard& b) { return b.name == board.name; });
    if (taken) entry.refuse("name", "is \"" + board.name + "\", which another board has, too");
    if (std::any_of(known.begin(), known.end(),
                    [&](const ar::TagGridSpec& grid) { return shareTags(grid, board.grid); }))
      entry.refuse("first_id", "makes tags that another board has, too");
    known.push_back(board.grid);
    boards.push_back(std::move(board));
  }
  return boards;
}

std::vector<RealThing> readRealThings(const JsonFile& file, const std::filesystem::path& base,
                                      const std::vector<OtherBoard>& boards) {
  std::vector<RealThing> things;
  for (const JsonFile& entry : file.entries("real_things")) {
    RealThing thing;
    thing.mesh = base / entry.text("mesh");
    thing.metres = unitOf(entry);
    thing.X = readPose(entry, "X");
    const std::string on = entry.text("on");
    const auto board = std::find_if(boards.begin(), boards.end(),
                                    [&](const OtherBoard& b) { return b.name == on; });
    if (on == "table")
      thing.on = RealThing::On::table;
    else if (on == "tool")
      thing.on = RealThing::On::tool;
    else if (board == boards.end())
      entry.refuse("on", "is \"" + on + "\"; known are table, tool, and the names of \"boards\"");
    else
      thing.on = RealThing::On::board;
    thing.board = static_cast<std::size_t>(board - boards.begin());
    things.push_back(std::move(thing));
  }
  return things;
}

}  // namespace palpa::station
