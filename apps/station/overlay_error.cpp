#include "apps/station/overlay_error.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "calibration/rotation.h"

namespace palpa::station {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix2X = Eigen::Matrix<double, 2, Eigen::Dynamic>;
constexpr int kLensSize = 9;   // fx fy cx cy k1 k2 p1 p2 k3, as a camera's calibration lists them

/// The camera with number `i` of its lens moved by `step`.
calibration::CameraModel nudged(calibration::CameraModel camera, int i, double step) {
  const std::array<double*, kLensSize> numbers{&camera.fx,           &camera.fy,           &camera.cx,           &camera.cy, &camera.distortion[0],
                                               &camera.distortion[1], &camera.distortion[2], &camera.distortion[3], &camera.distortion[4]};
  *numbers[static_cast<std::size_t>(i)] += step;
  return camera;
}

Eigen::Matrix<double, 2, kLensSize> byLens(const calibration::CameraModel& camera, const Vec3& p_C) {
  Eigen::Matrix<double, 2, kLensSize> J;
  for (int i = 0; i < kLensSize; ++i) {
    const double step = i < 4 ? 1e-3 : 1e-6;
    J.col(i) = (nudged(camera, i, step).project(p_C) - nudged(camera, i, -step).project(p_C)) / (2 * step);
  }
  return J;
}

/// Of a pixel by the board's pose (exp([w]) R, t + v).
Eigen::Matrix<double, 2, 6> byPose(const calibration::CameraModel& camera, const Pose& X_CW, const Vec3& p_W) {
  Eigen::Matrix<double, 2, 3> J_p;
  camera.project(X_CW * p_W, &J_p);
  Eigen::Matrix<double, 3, 6> J;
  J << -calibration::crossMatrix(X_CW.rotation() * p_W), Mat3::Identity();
  return J_p * J;
}

/// How the board's pose, found with a lens, moves with that lens: -(sum J_b' J_b)^-1 sum J_b' J_c over the board's corners.
Eigen::Matrix<double, 6, kLensSize> poseByLens(const Station& station, const Pose& X_CW) {
  Matrix6 A = Matrix6::Zero();
  Eigen::Matrix<double, 6, kLensSize> B = Eigen::Matrix<double, 6, kLensSize>::Zero();
  for (int tag = 0; tag < station.board.columns * station.board.rows; ++tag)
    for (const Vec3& p_W : ar::tagCorners(station.board, station.board.first_id + tag)) {
      const Eigen::Matrix<double, 2, 6> J = byPose(station.camera, X_CW, p_W);
      A += J.transpose() * J;
      B += J.transpose() * byLens(station.camera, X_CW * p_W);
    }
  return -A.ldlt().solve(B);
}

}  // namespace

std::optional<OverlayError> predictOverlayError(const Station& station, const Pose& X_DE, const ar::BoardPose& board) {
  const AppliedCalibration* tool = calibrationOf(station.calibrations, "tool");
  const AppliedCalibration* registration = calibrationOf(station.calibrations, "registration");
  if (!tool || !registration || tool->file.covariance.rows() != 6 || registration->file.covariance.rows() != 6) return std::nullopt;
  const Vec3 p_D = X_DE * station.X_ET.translation();
  const Mat3 R_WE = station.X_WD.rotation() * X_DE.rotation();
  const Mat3 S_W = calibration::pointCovariance(station.X_WD, Matrix6(registration->file.covariance), p_D) +
                   R_WE * tool->file.covariance.bottomRightCorner<3, 3>() * R_WE.transpose();
  const Vec3 tip_W = station.X_WD * p_D;
  Eigen::Matrix<double, 2, 3> J_p;
  station.camera.project(board.X_CW * tip_W, &J_p);
  const Eigen::Matrix<double, 2, 3> J_W = J_p * board.X_CW.rotation();
  const Eigen::Matrix<double, 2, 6> J_b = byPose(station.camera, board.X_CW, tip_W);
  Eigen::Matrix2d S_px = J_W * S_W * J_W.transpose() + J_b * board.covariance * J_b.transpose();
  const AppliedCalibration* camera = calibrationOf(station.calibrations, "camera");
  if (camera && camera->file.covariance.rows() == kLensSize) {
    const Eigen::Matrix<double, 2, kLensSize> J_c = byLens(station.camera, board.X_CW * tip_W) + J_b * poseByLens(station, board.X_CW);
    S_px += J_c * camera->file.covariance * J_c.transpose();
  }
  return OverlayError{1e3 * std::sqrt(S_W.trace()), std::sqrt(S_px.trace())};
}

}  // namespace palpa::station
