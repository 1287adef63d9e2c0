#include "apps/station/overlay_error.h"

#include <Eigen/Dense>
#include <cmath>

#include "calibration/rotation.h"

namespace palpa::station {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using calibration::kLensNumbers;

/// Of a pixel by the board's pose (exp([w]) R, t + v).
Eigen::Matrix<double, 2, 6> byPose(const calibration::CameraModel& camera, const Pose& X_CW,
                                   const Vec3& p_W) {
  Eigen::Matrix<double, 2, 3> J_p;
  camera.project(X_CW * p_W, &J_p);
  Eigen::Matrix<double, 3, 6> J;
  J << -calibration::crossMatrix(X_CW.rotation() * p_W), Mat3::Identity();
  return J_p * J;
}

/// How the board's pose, found with a lens, moves with that lens: -(sum J_b' J_b)^-1 sum J_b' J_c
/// over the board's corners.
Eigen::Matrix<double, 6, kLensNumbers> poseByLens(const Station& station, const Pose& X_CW) {
  Matrix6 A = Matrix6::Zero();
  Eigen::Matrix<double, 6, kLensNumbers> B = Eigen::Matrix<double, 6, kLensNumbers>::Zero();
  for (int tag = 0; tag < station.board.columns * station.board.rows; ++tag)
    for (const Vec3& p_W : ar::tagCorners(station.board, station.board.first_id + tag)) {
      const Eigen::Matrix<double, 2, 6> J = byPose(station.camera, X_CW, p_W);
      A += J.transpose() * J;
      B += J.transpose() * station.camera.byLens(X_CW * p_W);
    }
  return -A.ldlt().solve(B);
}

}  // namespace

std::optional<Mat3> predictTipCovariance(const Station& station, const Pose& X_DE) {
  const AppliedCalibration* tool = calibrationOf(station.calibrations, CalibrationKind::tool);
  const AppliedCalibration* registration =
      calibrationOf(station.calibrations, CalibrationKind::registration);
  if (!tool || !registration || tool->file.covariance.rows() != 6 ||
      registration->file.covariance.rows() != 6)
    return std::nullopt;
  const Mat3 R_WE = station.X_WD.rotation() * X_DE.rotation();
  return calibration::pointCovariance(station.X_WD, Matrix6(registration->file.covariance),
                                      X_DE * station.X_ET.translation()) +
         R_WE * tool->file.covariance.bottomRightCorner<3, 3>() * R_WE.transpose();
}

std::optional<OverlayError> predictOverlayError(const Station& station, const Pose& X_DE,
                                                const ar::BoardPose& board) {
  const auto S_W = predictTipCovariance(station, X_DE);
  if (!S_W) return std::nullopt;
  const Vec3 tip_W = (station.X_WD * X_DE * station.X_ET).translation(), tip_C = board.X_CW * tip_W;
  Eigen::Matrix<double, 2, 3> J_p;
  station.camera.project(tip_C, &J_p);
  const Eigen::Matrix<double, 2, 3> J_W = J_p * board.X_CW.rotation();
  const Eigen::Matrix<double, 2, 6> J_b = byPose(station.camera, board.X_CW, tip_W);
  Eigen::Matrix2d S_px = J_W * *S_W * J_W.transpose() + J_b * board.covariance * J_b.transpose();
  const AppliedCalibration* camera = calibrationOf(station.calibrations, CalibrationKind::camera);
  if (camera && camera->file.covariance.rows() == kLensNumbers) {
    const Eigen::Matrix<double, 2, kLensNumbers> J_c =
        station.camera.byLens(tip_C) + J_b * poseByLens(station, board.X_CW);
    S_px += J_c * camera->file.covariance * J_c.transpose();
  }
  return OverlayError{1e3 * std::sqrt(S_W->trace()), std::sqrt(S_px.trace())};
}

}  // namespace palpa::station
