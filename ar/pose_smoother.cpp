#include "ar/pose_smoother.h"

#include <cmath>
#include <numbers>

namespace palpa::ar {
namespace {

double alpha(double cutoff_hz, double T) {
  return 1 / (1 + 1 / (2 * std::numbers::pi * cutoff_hz * T));
}

Vec3 logarithm(const Mat3& R) {
  const Eigen::AngleAxisd turn{Quat(R)};
  return turn.angle() * turn.axis();
}

Mat3 exponential(const Vec3& w) {
  const double angle = w.norm();
  if (angle == 0) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

}  // namespace

void PoseSmoother::start(const Pose& X_raw, std::int64_t t_ns) {
  started_ = true;
  t_ns_ = t_ns;
  raw_ = smooth_ = X_raw;
  v_.setZero();
  w_.setZero();
}

Pose PoseSmoother::update(const Pose& X_raw, std::int64_t t_ns) {
  const double T = double(t_ns - t_ns_) * 1e-9;
  if (!started_ || T > settings_.longest_gap) {
    start(X_raw, t_ns);
    return smooth_;
  }
  if (!(T > 0)) return smooth_;

  const double a_speed = alpha(settings_.speed_cutoff_hz, T);
  v_ += a_speed * ((X_raw.translation() - raw_.translation()) / T - v_);
  w_ += a_speed * (logarithm(raw_.linear().transpose() * X_raw.linear()) / T - w_);

  const double a_p = alpha(settings_.min_cutoff_hz + settings_.beta_translation * v_.norm(), T);
  const double a_R = alpha(settings_.min_cutoff_hz + settings_.beta_rotation * w_.norm(), T);
  const Mat3 R = smooth_.linear();
  smooth_.translation() += a_p * (X_raw.translation() - smooth_.translation());
  smooth_.linear() = Quat(R * exponential(a_R * logarithm(R.transpose() * X_raw.linear())))
                         .normalized()
                         .toRotationMatrix();
  raw_ = X_raw;
  t_ns_ = t_ns;
  return smooth_;
}

}  // namespace palpa::ar
