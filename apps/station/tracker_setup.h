#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/station/json_file.h"

namespace palpa::station {

/// A tracking system that measures where the camera is on the table, in place of the board in its
/// pictures: "plus", a PLUS server or any other that speaks OpenIGTLink. K: the marker on the
/// camera, R: the marker on the table; the server sends X_KR. X_CW = X_CK X_KR X_RW.
struct TrackerSetup {
  std::string host = "localhost";
  std::uint16_t port = 18944;
  std::string transform;         ///< as the server names X_KR: "ReferenceToCamera"
  Pose X_CK = Pose::Identity();  ///< the camera's marker in the camera
  Pose X_RW = Pose::Identity();  ///< the board's frame W in the table's marker
  double latency_s = 0;          ///< from the measurement to its arrival here
  double stale_s = 0.1;          ///< beyond, the camera counts as lost
  double sigma = 0.3e-3,
         sigma_rad = 2e-3;  ///< standard deviation of each component of X_CW, m and rad
  int ask_tdata_ms =
      0;  ///< for servers that send tracking data only when asked; 0: they send by themselves
};

/// Section "tracker", where there is one. Throws UsageError.
std::optional<TrackerSetup> readTracker(const JsonFile& file);

}  // namespace palpa::station
