#include "ar/pose_motion.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "calibration/rotation.h"

namespace palpa::ar {
namespace {

using Mat33 = Eigen::Matrix3d;

/// Of (pose, rate, acceleration) along one axis.
Mat33 singerTransition(double dt, double memory) {
  const double e = std::exp(-dt / memory);
  Mat33 F;
  F << 1, dt, memory * (dt - memory * (1 - e)),  //
      0, 1, memory * (1 - e),                    //
      0, 0, e;
  return F;
}

/// For an acceleration of unit standard deviation: the integral of F(s) g g' F(s)' 2 / memory over
/// s from 0 to dt, g = (0, 0, 1); Simpson's rule.
Mat33 singerNoise(double dt, double memory) {
  constexpr int kIntervals = 8;
  Mat33 Q = Mat33::Zero();
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1 : i % 2 ? 4 : 2;
    const Vec3 column = singerTransition(dt * i / kIntervals, memory).col(2);
    Q += weight * column * column.transpose();
  }
  return Q * (dt / kIntervals / 3) * 2 / memory;
}

Vector6 perKind(double of_turn, double of_shift) {
  Vector6 v;
  v << of_turn, of_turn, of_turn, of_shift, of_shift, of_shift;
  return v;
}

/// One axis's matrix for all six: block (i, j) is m(i, j) times diag(scale).
Matrix18 forAllAxes(const Mat33& m, const Vector6& scale) {
  Matrix18 all;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      all.block<6, 6>(6 * i, 6 * j) = m(i, j) * Matrix6(scale.asDiagonal());
  return all;
}

}  // namespace

Vector6 difference(const Pose& a, const Pose& b) {
  Vector6 d;
  d << calibration::rotationVector(a.linear() * b.linear().transpose()),
      a.translation() - b.translation();
  return d;
}

Pose stepped(const Pose& X, const Vector6& step) {
  const Mat3 R =
      Quat(calibration::rotationOf(step.head<3>()) * X.linear()).normalized().toRotationMatrix();
  return makePose(R, X.translation() + step.tail<3>());
}

PoseMotion predicted(const PoseMotion& motion, const MotionModel& model, double dt) {
  PoseMotion next;
  if (model.still) {
    next.X = motion.X;
    next.covariance.topLeftCorner<6, 6>() = motion.covariance.topLeftCorner<6, 6>();
    next.covariance.topLeftCorner<6, 6>().diagonal() +=
        dt * perKind(model.walk_rad, model.walk_m).cwiseAbs2();
    return next;
  }
  const Mat33 F = singerTransition(dt, model.memory);
  next.X = stepped(motion.X, F(0, 1) * motion.rate + F(0, 2) * motion.acceleration);
  next.rate = motion.rate + F(1, 2) * motion.acceleration;
  next.acceleration = F(2, 2) * motion.acceleration;
  const Matrix18 F_all = forAllAxes(F, Vector6::Ones());
  next.covariance = F_all * motion.covariance * F_all.transpose() +
                    forAllAxes(singerNoise(dt, model.memory),
                               perKind(model.acceleration_rad, model.acceleration_m).cwiseAbs2());
  return next;
}

PoseMotion updated(const PoseMotion& motion, const Pose& X_measured, const Matrix6& covariance,
                   double* log_likelihood) {
  const Vector6 innovation = difference(X_measured, motion.X);
  const Matrix6 S = motion.covariance.topLeftCorner<6, 6>() + covariance;
  const Eigen::LLT<Matrix6> llt(S);
  const Eigen::Matrix<double, 18, 6> K =
      llt.solve(motion.covariance.leftCols<6>().transpose()).transpose();
  const Eigen::Matrix<double, 18, 1> step = K * innovation;
  if (log_likelihood)
    *log_likelihood = -0.5 * innovation.dot(llt.solve(innovation)) -
                      Matrix6(llt.matrixL()).diagonal().array().log().sum();
  PoseMotion next;
  next.X = stepped(motion.X, step.head<6>());
  next.rate = motion.rate + step.segment<6>(6);
  next.acceleration = motion.acceleration + step.tail<6>();
  next.covariance = motion.covariance - K * S * K.transpose();
  next.covariance = 0.5 * (next.covariance + next.covariance.transpose()).eval();
  return next;
}

double surprise(const PoseMotion& motion, const Pose& X_measured, const Matrix6& covariance) {
  const Vector6 innovation = difference(X_measured, motion.X);
  return innovation.dot(
      (motion.covariance.topLeftCorner<6, 6>() + covariance).llt().solve(innovation));
}

}  // namespace palpa::ar
