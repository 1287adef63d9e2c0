#include "apps/station/station_file.h"

#include "anatomy/base/enum_names.h"
#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/units.h"
#include "anatomy/geometry/pose.h"
#include "haptics/safety/passivity.h"

namespace palpa::station {
namespace {

constexpr int kStationVersion = 1;
constexpr double kLongestPeriod = 1e-3;  // s: the loop runs at 1 kHz or faster
// Of the virtual camera, whose pictures are drawn: 8K at 30 Hz.
constexpr double kMostPixelsPerSecond = 1e9;
constexpr double kDampedShare = 0.2;  // of m / T: more would make a sampled damper unstable itself

calibration::CameraModel readCamera(const JsonFile& file) {
  calibration::CameraModel camera;
  camera.width = file.integer("camera/width_px", 64, 8192);
  camera.height = file.integer("camera/height_px", 64, 8192);
  camera.fx = file.number("camera/fx_px", 10, 1e5);
  camera.fy = file.number("camera/fy_px", 10, 1e5);
  camera.cx = file.number("camera/cx_px", -1e4, 1e4);
  camera.cy = file.number("camera/cy_px", -1e4, 1e4);
  static constexpr const char* kTerms[5] = {"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < 5; ++i)
    camera.distortion[i] = file.number(std::string("camera/distortion/") + kTerms[i], -10, 10);
  return camera;
}

const EnumNames<CameraDriver> kCameraDrivers{"bench", "webcam"};
const EnumNames<haptics::ToolShape> kToolShapes{"point", "line", "flat"};

/// What is not there is the bench's.
CameraSetup readCameraSetup(const JsonFile& file) {
  CameraSetup setup;
  if (!file.has("camera/driver")) return setup;
  setup.driver = kCameraDrivers.in(file, "camera/driver", "known are bench and webcam");
  if (setup.driver == CameraDriver::bench) return setup;
  setup.device = file.text("camera/device");
  setup.exposure_ms = file.number("camera/exposure_ms", 0.1, 1000);
  if (file.has("camera/gain")) setup.gain = file.number("camera/gain", 0, 1e6);
  if (file.has("camera/focus")) setup.focus = file.number("camera/focus", 0, 1e6);
  return setup;
}

/// A place that an arm may reach, metres.
Vec3 placeIn(const JsonFile& file, const std::string& at) {
  constexpr double kFarthest_mm = 5000;
  const Vec3 p_mm = unpack(file.triple(at));
  if (p_mm.cwiseAbs().maxCoeff() > kFarthest_mm) file.refuse(at, "is more than 5 m away");
  return kMm * p_mm;
}

std::vector<Landmark> readLandmarks(const JsonFile& file) {
  std::vector<Landmark> landmarks;
  if (!file.has("landmarks")) return landmarks;
  if (!file.json().at("landmarks").is_array()) file.refuse("landmarks", "must be a list");
  for (const nlohmann::json& item : file.json().at("landmarks")) {
    const JsonFile landmark(item, file.name() + ", \"landmarks\"");
    const std::string use = landmark.text("for");
    if (use != "fit" && use != "check") landmark.refuse("for", "must be \"fit\" or \"check\"");
    landmarks.push_back({landmark.text("name"), placeIn(landmark, "p_W_mm"), use == "check"});
  }
  return landmarks;
}

/// {"origin_W_mm", "spacing_mm", "counts"}: points named by their place along x, y, z.
std::vector<Landmark> readGrid(const JsonFile& file) {
  std::vector<Landmark> grid;
  if (!file.has("grid")) return grid;
  const Vec3 origin = placeIn(file, "grid/origin_W_mm"), spacing = placeIn(file, "grid/spacing_mm"),
             counts = unpack(file.triple("grid/counts"));
  if ((spacing.array() < 1e-3).any())
    file.refuse("grid/spacing_mm", "must be 1 mm or more each way");
  if ((counts.array() < 1).any() || (counts.array() > 10).any() ||
      counts != Vec3(counts.array().round()))
    file.refuse("grid/counts", "must be whole numbers from 1 to 10");
  for (int k = 0; k < static_cast<int>(counts.z()); ++k)
    for (int j = 0; j < static_cast<int>(counts.y()); ++j)
      for (int i = 0; i < static_cast<int>(counts.x()); ++i)
        grid.push_back(
            {std::to_string(i + 1) + "-" + std::to_string(j + 1) + "-" + std::to_string(k + 1),
             origin + spacing.cwiseProduct(Vec3(i, j, k)), false});
  return grid;
}

struct Box {
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
};

Box skinBox(const anatomy::Patient& patient) {
  Box box;
  for (const Vec3& p : patient.organ(Organ::skin).mesh.points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

/// Supine: left stays left, posterior is down, superior is away from the reader.
Mat3 supine() {
  Mat3 R;
  R.col(0) = Vec3::UnitX();
  R.col(1) = -Vec3::UnitZ();
  R.col(2) = Vec3::UnitY();
  return R;
}

void needFewPixels(const JsonFile& file, const Station& s) {
  if (s.camera_rate_Hz * s.camera.width * s.camera.height > kMostPixelsPerSecond)
    file.refuse("camera/rate_Hz",
                "asks for more pixels a second than can be drawn: make the pictures smaller or "
                "fewer");
}

// Of force: what the device can do bounds what the file may ask for.
void readLimits(const JsonFile& file, Station& s) {
  const haptics::DeviceCapabilities& can = s.device.capabilities;
  s.safety.max_force_N = file.number("safety/max_force_N", 0.1, can.max_force_N);
  s.safety.max_slew_N_per_s = file.number("safety/max_slew_N_per_s", 10, 1e5);
  s.safety.max_energy_J = file.number("safety/max_energy_J", 1e-3, 5);
  if (file.has("safety/deadman_button"))  // number of the button, from 0
    s.safety.deadman_button = 1u << file.integer("safety/deadman_button", 0, 31);
  s.safety.continuous_force_N = s.device.continuous_force_N;
  s.safety.thermal_tau = s.device.thermal_tau;
  const double stable = haptics::couplingStiffness(can, kLongestPeriod);
  s.coupling.stiffness = file.number("coupling/stiffness_N_per_m", 10, stable);
  if (file.has("coupling/velocity_tau_ms"))
    s.coupling.velocity_tau = 1e-3 * file.number("coupling/velocity_tau_ms", 0.1, 50);
  s.passivity.max_damping = kDampedShare * can.apparent_mass / kLongestPeriod;
  s.passivity.coulomb = can.coulomb_friction;
}

}  // namespace

Station readStation(const std::filesystem::path& path) {
  JsonFile file(path);
  needKind(file, "station", kStationVersion);
  Station s;
  s.file = file;
  s.id = file.text("id");
  s.title = file.text("title");
  s.device = readDevice(file, path.parent_path());
  s.force_sensor = readForceSensor(file);
  s.camera = readCamera(file);
  s.camera_setup = readCameraSetup(file);
  s.tracker = readTracker(file);
  if (file.has("stop_pedal")) {
    s.stop_pedal = file.text("stop_pedal");
    if (!s.stop_pedal.starts_with('/'))
      file.refuse("stop_pedal", "is no path such as /dev/input/by-id/...-event-kbd");
  }
  s.camera_rate_Hz = file.number("camera/rate_Hz", 1, 240);
  const bool on_bench = s.camera_setup.driver ==
                        CameraDriver::bench;  // where a picture is seen before the next is taken
  if (on_bench) needFewPixels(file, s);
  s.camera_latency_s =
      1e-3 * file.number("camera/latency_ms", 0, on_bench ? 1000 / s.camera_rate_Hz : 1000);
  s.simulated = on_bench || s.device.driver == DeviceDriver::bench;
  s.board = readBoard(file, "board");
  if (file.has("marker")) s.marker = readBoard(file, "marker");
  std::vector<ar::TagGridSpec> grids{s.board};
  if (s.marker) grids.push_back(*s.marker);
  s.boards = readOtherBoards(file, grids);
  s.things = readRealThings(file, path.parent_path(), s.boards);
  s.landmarks = readLandmarks(file);
  if (file.has("sample"))
    s.sample = SoftSample{readPose(file, "sample/X_WP"),
                          1e-3 * file.number("sample/tip_radius_mm", 1, 30)};
  if (file.has("floor"))
    s.floor = FloorSetup{readPose(file, "floor/X_WF"), kMm * file.number("floor/unit_mm", 0.01, 2),
                         file.number("floor/handle_weight_N", 0, 10)};
  s.grid = readGrid(file);
  s.decimate = file.number("camera/decimate", 1, 4);
  s.X_WD = readPose(file, "registration/X_WD");
  s.X_ET = readPose(file, "tool/X_ET");
  if (file.has("tool/shape")) s.tool_shape = kToolShapes.in(file, "tool/shape");
  if (file.has("second_device")) s.second_X_WD = readPose(file, "second_device/X_WD");
  s.entry_W = kMm * unpack(file.triple("patient/entry_mm"));
  readLimits(file, s);
  s.calibration_verdict = file.text("calibration/verdict");
  s.calibration_date = file.text("calibration/date");
  s.design = {s.camera, s.X_WD, s.X_ET, s.camera_latency_s, s.force_sensor};
  s.calibrations = readCalibrations(file, path.parent_path());
  applyCalibrations(s);
  return s;
}

Pose placePatient(const anatomy::Patient& patient, const Vec3& entry_W) {
  const double sign = patient.side == anatomy::Side::right ? 1 : -1;
  const Vec3 there(sign * entry_W.x(), entry_W.y(), entry_W.z());
  return makePose(supine(), there - supine() * patient.landmark(anatomy::landmark::kEntry));
}

Pose placePatientOnBoard(const anatomy::Patient& patient) {
  const Box box = skinBox(patient);
  const Vec3 middle = 0.5 * (box.low + box.high);
  return makePose(supine(), -(supine() * Vec3(middle.x(), box.high.y(), middle.z())));
}

}  // namespace palpa::station
