#include "apps/calibrate/sequence.h"

#include <algorithm>

#include "anatomy/geometry/error.h"
#include "anatomy/geometry/whole_file.h"
#include "apps/calibrate/camera_result.h"
#include "apps/station/sha256.h"

namespace palpa::calibrate {
namespace {

/// Begins a result's list of what it rests on.
void restOn(Result& result, const SetupResult& setup, const std::vector<std::string>& kinds) {
  for (const std::string& kind : kinds)
    if (const station::AppliedCalibration* other = station::calibrationOf(setup.calibrations, kind)) result.file.rests_on.push_back({kind, other->sha256});
}

Vec3 tipOf(const Result& tool) { return station::poseAt(tool.file, "X_ET").translation(); }

/// The hole for the tip: the middle landmark, where the tool can lean every way.
Vec3 holeOf(const station::Station& station) {
  if (station.landmarks.empty()) throw Error("has no \"landmarks\"", station.file.name(), "List the points that a tip can be put on: name and p_W_mm");
  return station.landmarks.front().p_W;
}

std::vector<calibration::HandEyeSample> tagSamples(const std::vector<HeldPose>& held) {
  std::vector<calibration::HandEyeSample> samples;
  for (const HeldPose& pose : held)
    if (pose.seen) samples.push_back({pose.X_DE, pose.X_WM});
  return samples;
}

std::vector<calibration::StaticReading> forceReadings(const std::vector<HeldPose>& held, const station::ForceSensorSetup& sensor) {
  std::vector<calibration::StaticReading> readings;
  for (const HeldPose& pose : held) readings.push_back({pose.X_DE.rotation() * sensor.X_ES.rotation(), pose.f_S, pose.m_S});
  return readings;
}

}  // namespace

station::AppliedCalibration keep(const Result& result, const std::filesystem::path& folder) {
  station::AppliedCalibration kept;
  kept.path = folder / (result.file.kind + ".json");
  kept.file = result.file;
  station::writeCalibration(result.file, kept.path);
  kept.sha256 = kept.sha256_wanted = station::sha256OfFile(kept.path);
  return kept;
}

void writeStation(const station::Station& station, const std::vector<station::AppliedCalibration>& calibrations, const std::filesystem::path& file) {
  std::vector<station::AppliedCalibration> all = calibrations;
  for (const station::AppliedCalibration& before : station.calibrations)
    if (!station::calibrationOf(calibrations, before.file.kind)) all.push_back(before);
  nlohmann::json json = station.file.json();
  json["calibrations"] = station::toJson(all, file.parent_path());
  writeWhole(file, json.dump(2) + "\n");
}

SetupResult setUp(const Scene& scene, Origin origin, const std::filesystem::path& folder) {
  const station::Station& station = scene.station;
  SetupResult setup;
  const auto add = [&](Result result, const std::vector<std::string>& rests_on) {
    restOn(result, setup, rests_on);
    setup.calibrations.push_back(keep(result, folder));
    setup.results.push_back(std::move(result));
  };
  calibration::CameraModel camera;
  add(cameraResult(collectViews(scene), station.camera.width, station.camera.height, origin, &camera), {});
  const Vec3 hole_W = holeOf(station);
  ToolSamples tool;
  tool.pivot = collectPivot(scene, hole_W);
  tool.spin = collectSpin(scene, hole_W);
  add(toolResult(tool, station.design.X_ET, origin), {});
  const Vec3 tip_E = tipOf(setup.results.back());
  const std::vector<TouchedPose> touched = collectTouches(scene);
  std::vector<HeldPose> held;
  if (station.marker) held = collectHeld(scene, camera);
  add(registrationResult(touchesOf(touched, tip_E), tagSamples(held), station.entry_W, origin), {"camera", "tool"});
  const Result& registration = setup.results.back();
  if (station.marker) {
    const Vec3 p_EM = station::poseAt(registration.file, "X_EM").translation();
    const Vec3 down_D = station::poseAt(registration.file, "X_WD").rotation().transpose() * -Vec3::UnitZ();
    add(latencyResult(collectWave(scene, camera, p_EM), station.camera_latency_s, origin), {"camera"});
    if (station.force_sensor) add(forceSensorResult(forceReadings(held, *station.force_sensor), down_D, origin), {});
  }
  if (const std::optional<runtime::Moment> last = scene.rig.next()) setup.seconds = last->t;
  return setup;
}

}  // namespace palpa::calibrate
