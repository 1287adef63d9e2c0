#include "apps/calibrate/sequence.h"

#include <algorithm>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "apps/calibrate/results.h"
#include "apps/calibrate/rig_adapters.h"

namespace palpa::calibrate {
namespace {

Vec3 tipOf(const Result& tool) { return station::poseAt(tool.file, "X_ET").translation(); }

/// The hole for the tip: the first landmark.
Vec3 holeOf(const station::Station& station) {
  if (station.landmarks.empty())
    throw Error("has no \"landmarks\"", station.file.name(),
                "List the points that a tip can be put on: name and p_W_mm");
  return station.landmarks.front().p_W;
}

TagSamples tagSamples(const std::vector<HeldPose>& held, const calibration::CameraModel& camera) {
  TagSamples samples;
  samples.camera = camera;
  for (const HeldPose& pose : held) {
    if (!pose.seen) continue;
    samples.poses.push_back({pose.X_DE, pose.X_WM});
    samples.views.push_back(pose.view);
  }
  return samples;
}

std::vector<calibration::StaticReading> forceReadings(const std::vector<HeldPose>& held,
                                                      const station::ForceSensorSetup& sensor) {
  std::vector<calibration::StaticReading> readings;
  for (const HeldPose& pose : held)
    readings.push_back({pose.X_DE.rotation() * sensor.X_ES.rotation(), pose.f_S, pose.m_S});
  return readings;
}

}  // namespace

void restOn(Result& result, const std::vector<station::AppliedCalibration>& calibrations) {
  using station::CalibrationKind;
  static const std::map<CalibrationKind, std::vector<CalibrationKind>> kNeeds{
      {CalibrationKind::tool, {CalibrationKind::workspace}},
      {CalibrationKind::registration,
       {CalibrationKind::camera, CalibrationKind::workspace, CalibrationKind::tool}},
      {CalibrationKind::latency, {CalibrationKind::camera}}};
  const auto needs = kNeeds.find(result.file.kind);
  if (needs == kNeeds.end()) return;
  for (const CalibrationKind kind : needs->second)
    if (const station::AppliedCalibration* other = station::calibrationOf(calibrations, kind))
      result.file.rests_on.push_back({nameOf(kind), other->sha256});
}

station::AppliedCalibration asFile(const Result& result) {
  station::AppliedCalibration kept;
  kept.path = nameOf(result.file.kind) + ".json";
  kept.file = result.file;
  kept.sha256 = kept.sha256_wanted = sha256(station::textOf(result.file));
  return kept;
}

void writeCalibrations(const station::Station& station,
                       const std::vector<station::AppliedCalibration>& calibrations,
                       const std::filesystem::path& folder) {
  std::vector<station::AppliedCalibration> all;
  for (station::AppliedCalibration c : calibrations) {
    station::writeCalibration(c.file, folder / c.path);
    c.path = folder / c.path;
    all.push_back(std::move(c));
  }
  for (const station::AppliedCalibration& before : station.calibrations)
    if (!station::calibrationOf(calibrations, before.file.kind)) all.push_back(before);
  nlohmann::json json = station.file.json();
  json["calibrations"] = station::toJson(all, folder);
  writeWhole(folder / "station.json", json.dump(2) + "\n");
}

ToolSamples collectTool(const Scene& scene) {
  const Vec3 hole_W = holeOf(scene.station);
  ToolSamples samples;
  samples.pivot = collectPivot(scene, hole_W);
  samples.spin = collectSpin(scene, hole_W);
  return samples;
}

Result collectedWorkspace(const Scene& scene, const Vec3& tip_E, const Origin& origin,
                          calibration::WorkspaceMap* found) {
  if (scene.station.grid.empty())
    throw Error("has no \"grid\"", scene.station.file.name(),
                "Describe the grid of holes: origin_W_mm, spacing_mm, counts");
  return workspaceResult(touchesOf(collectTouches(scene, scene.station.grid), tip_E), origin,
                         found);
}

ToolSamples corrected(ToolSamples samples, const calibration::WorkspaceMap& map) {
  for (std::vector<Pose>* poses : {&samples.pivot, &samples.spin})
    for (Pose& X : *poses) X.translation() = map.corrected(X.translation());
  return samples;
}

Result collectedRegistration(const Scene& scene, const std::vector<HeldPose>& held,
                             const calibration::CameraModel& camera, const Vec3& tip_E,
                             const Origin& origin) {
  holeOf(scene.station);
  return registrationResult(touchesOf(collectTouches(scene, scene.station.landmarks), tip_E),
                            tagSamples(held, camera), scene.station.entry_W, origin);
}

Result collectedLatency(const Scene& scene, const calibration::CameraModel& camera,
                        const Vec3& p_EM, const Origin& origin) {
  return latencyResult(collectWave(scene, camera, p_EM), scene.station.camera_latency_s, origin);
}

Result forceSensorOf(const Scene& scene, const std::vector<HeldPose>& held, const Pose& X_WD,
                     const Origin& origin) {
  if (!scene.station.force_sensor)
    throw UsageError("has no \"force_sensor\"", scene.station.file.name(),
                     "Describe the sensor in the station's file");
  return forceSensorResult(forceReadings(held, *scene.station.force_sensor),
                           X_WD.rotation().transpose() * -Vec3::UnitZ(), origin);
}

Vec3 markerOf(const std::vector<HeldPose>& held) {
  return calibration::calibrateHandEye(tagSamples(held, {}).poses).X_EM.translation();
}

SetupResult setUp(const Scene& raw, const Origin& origin) {
  const station::Station& station = raw.station;
  CorrectedRig corrected_rig(raw.rig);
  const Scene scene{station, corrected_rig, raw.guide};
  SetupResult setup;
  const auto add = [&](Result result) {
    restOn(result, setup.calibrations);
    setup.calibrations.push_back(asFile(result));
    setup.results.push_back(std::move(result));
  };
  calibration::CameraModel camera;
  add(cameraResult(collectViews(scene), station.camera.width, station.camera.height, origin,
                   &camera));
  ToolSamples tool = collectTool(scene);
  if (!station.grid.empty()) {
    calibration::WorkspaceMap map;
    add(collectedWorkspace(scene, tipOf(toolResult(tool, station.design.X_ET, origin)), origin,
                           &map));
    tool = corrected(tool, map);
    corrected_rig.correctBy(map);
  }
  add(toolResult(tool, station.design.X_ET, origin));
  const Vec3 tip_E = tipOf(setup.results.back());
  const std::vector<HeldPose> held =
      station.marker ? collectHeld(scene, camera) : std::vector<HeldPose>{};
  add(collectedRegistration(scene, held, camera, tip_E, origin));
  const station::CalibrationFile registration = setup.results.back().file;
  if (station.marker)
    add(collectedLatency(scene, camera, station::poseAt(registration, "X_EM").translation(),
                         origin));
  if (station.marker && station.force_sensor)
    add(forceSensorOf(scene, held, station::poseAt(registration, "X_WD"), origin));
  if (const std::optional<runtime::RigMoment> last = scene.rig.next()) setup.seconds = last->t;
  return setup;
}

}  // namespace palpa::calibrate
