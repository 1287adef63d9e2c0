#pragma once

#include <cstdint>

#include "apps/station/station_file.h"
#include "apps/twin/device_twin.h"
#include "calibration/camera_model.h"

namespace palpa::twin {

/// Where things truly are: drawn around the station's design (what its file says before anything
/// was calibrated) with the spreads of its section "twin", the same for a session and for a set-up
/// with one seed. Only the twin and reports on accuracy may see it.
struct WorldTruth {
  Pose X_WD = Pose::Identity(), X_ET = Pose::Identity();
  double camera_latency_s = 0;  ///< from exposure to delivery
  double clock_drift = 0;       ///< of the device's clock against the program's, s per s
};
WorldTruth drawWorld(const station::Station& station, std::uint64_t seed);

calibration::CameraModel trueCamera(const station::Station& station, std::uint64_t seed);
DeviceTruth trueDevice(const station::Station& station, std::uint64_t seed);
/// For a station with a force sensor.
SensorTruth trueSensor(const station::Station& station, std::uint64_t seed);

/// For a station with a sample: where it truly lies.
Pose trueSample(const station::Station& station, std::uint64_t seed);

/// X_CW of a camera on a boom on the trainee's side, looking between board and patient; `distance`,
/// m, from the board; `aside`: to its right, a share of that.
Pose boomView(double distance, double aside);
inline constexpr double kBoomAside = 0.04;  ///< standard deviation of `aside`, [chosen]
/// Where the station's stands.
Pose cameraOnBoom(const station::Station& station, std::uint64_t seed);
/// The boom sways a little: two slow sines of `sway`, m.
Pose swayed(const Pose& X_CW_boom, double sway, std::int64_t t_ns);
double boomSway(const station::Station& station);  ///< m

}  // namespace palpa::twin
