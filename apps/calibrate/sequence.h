#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/calibrate/collect.h"
#include "apps/station/calibrations.h"

namespace palpa::calibrate {

/// What a whole set-up found.
struct SetupResult {
  std::vector<Result> results;                            ///< in the order of their making
  std::vector<station::AppliedCalibration> calibrations;  ///< the same as files, not yet written
  double seconds = 0;                                     ///< of the program's clock
};

/// One routine each: asks, collects, estimates.
ToolSamples collectTool(const Scene& scene);
/// Throws Error for a station without a grid. `found`: where the map goes; may be null.
Result collectedWorkspace(const Scene& scene, const Vec3& tip_E, const Origin& origin,
                          calibration::WorkspaceMap* found = nullptr);
/// `held`: poses of the tool with its marker, of which those seen join in; none: landmarks alone.
/// `camera`: that the marker was seen with.
Result collectedRegistration(const Scene& scene, const std::vector<HeldPose>& held,
                             const calibration::CameraModel& camera, const Vec3& tip_E,
                             const Origin& origin);
/// `p_EM`: the marker on the end effector.
Result collectedLatency(const Scene& scene, const calibration::CameraModel& camera,
                        const Vec3& p_EM, const Origin& origin);
/// Throws UsageError for a station without a force sensor.
Result forceSensorOf(const Scene& scene, const std::vector<HeldPose>& held, const Pose& X_WD,
                     const Origin& origin);
/// The marker on the end effector by `held`.
Vec3 markerOf(const std::vector<HeldPose>& held);

/// Camera, workspace (for a station with a grid), tool, registration (landmarks and tag), time and,
/// where there is one, force sensor: one after the other, each with what the former ones found.
/// Writes nothing. Throws Error for data that cannot tell an answer.
SetupResult setUp(const Scene& scene, const Origin& origin);

/// Notes in a result which of `calibrations` it was computed with: the tool with the workspace's
/// map; the registration with that map, camera and tool; the latency with the camera. The force
/// sensor needs of a registration only which way is down, which a new one does not move by what
/// matters.
void restOn(Result& result, const std::vector<station::AppliedCalibration>& calibrations);

/// A result as the calibration "<kind>.json" that a station refers to; not yet written.
station::AppliedCalibration asFile(const Result& result);

/// The files into `folder`, and with them "station.json": the station's file that refers to them in
/// place of those of the same kind. Throws Error.
void writeCalibrations(const station::Station& station,
                       const std::vector<station::AppliedCalibration>& calibrations,
                       const std::filesystem::path& folder);

}  // namespace palpa::calibrate
