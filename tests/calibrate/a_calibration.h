#pragma once

#include "apps/station/calibration_file.h"
#include "tests/support/complaint.h"

namespace palpa::test {

/// A tool calibration that is in order.
inline station::CalibrationFile aCalibration() {
  station::CalibrationFile c;
  c.kind = station::CalibrationKind::tool;
  c.station = "virtual-bench";
  c.date = "2026-03-01T12:30:00Z";
  c.made_by = "palpa calibrate tool";
  c.simulated = true;
  c.valid_days = 90;
  addPose(c, "X_ET",
          makePose(Mat3(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix()),
                   Vec3(0.001, -0.002, 0.11)));
  for (const char* name :
       {"turn_x_rad", "turn_y_rad", "turn_z_rad", "shift_x_m", "shift_y_m", "shift_z_m"})
    c.coordinates.push_back(name);
  c.covariance = 1e-9 * Eigen::MatrixXd::Identity(6, 6);
  c.covariance(0, 3) = c.covariance(3, 0) = 2e-10;
  c.residuals = {"m", 1.5e-4, {1e-4, 2e-4, 0.1 / 3}, {2}};
  c.data = {300, 299, "recorded files", {{"pivot.csv", "12ab"}}};
  c.checks = {{"the tip's uncertainty", 0.01, 0.25, "mm"}};
  c.rests_on = {{"camera", "abc"}};
  c.verdict = "pass";
  return c;
}

}  // namespace palpa::test
