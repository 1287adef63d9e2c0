#include "ar/tracking/pose_filter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

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

namespace {

constexpr double kForeign = 38.26;  // chi-squared, six degrees of freedom: 1 in a million
constexpr double kFirstSpeed_rad = 2,
                 kFirstSpeed_m = 0.5;  // rad/s, m/s: how fast it may move when it is first seen
constexpr double kJumpSpeed =
    1.0;  // m/s: two outliers nearer to each other than this takes are one thing

using Motions = std::array<PoseMotion, PoseFilter::kModels>;
using Weights = std::array<double, PoseFilter::kModels>;
using Vector18 = Eigen::Matrix<double, 18, 1>;

/// Mean and covariance of motions with weights that add up to 1, about the heaviest.
PoseMotion mixture(const Motions& motions, const Weights& weights) {
  const PoseMotion& base = motions[static_cast<std::size_t>(
      std::max_element(weights.begin(), weights.end()) - weights.begin())];
  std::array<Vector18, PoseFilter::kModels> apart;
  Vector18 mean = Vector18::Zero();
  for (std::size_t m = 0; m < motions.size(); ++m) {
    apart[m] << difference(motions[m].X, base.X), motions[m].rate - base.rate,
        motions[m].acceleration - base.acceleration;
    mean += weights[m] * apart[m];
  }
  PoseMotion mixed;
  mixed.X = stepped(base.X, mean.head<6>());
  mixed.rate = base.rate + mean.segment<6>(6);
  mixed.acceleration = base.acceleration + mean.tail<6>();
  for (std::size_t m = 0; m < motions.size(); ++m)
    mixed.covariance +=
        weights[m] * (motions[m].covariance + (apart[m] - mean) * (apart[m] - mean).transpose());
  return mixed;
}

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

}  // namespace

void PoseFilter::start(const Pose& X, const Matrix6& covariance, std::int64_t t_ns) {
  started_ = true;
  t_ns_ = t_ns;
  outlier_.reset();
  belief_.fill(1.0 / kModels);
  for (std::size_t m = 0; m < kModels; ++m) {
    motion_[m] = {};
    motion_[m].X = X;
    motion_[m].covariance.topLeftCorner<6, 6>() = covariance;
    const MotionModel& model = settings_.models[m];
    if (model.still) continue;
    Vector6 speed, steering;
    speed << Vec3::Constant(kFirstSpeed_rad), Vec3::Constant(kFirstSpeed_m);
    steering << Vec3::Constant(model.acceleration_rad), Vec3::Constant(model.acceleration_m);
    motion_[m].covariance.block<6, 6>(6, 6) = speed.cwiseAbs2().asDiagonal();
    motion_[m].covariance.block<6, 6>(12, 12) = steering.cwiseAbs2().asDiagonal();
  }
  mixed_ = motion_[0];
}

/// Before a step of `dt`: how likely each model is now, and where each starts from.
void PoseFilter::mix(double dt) {
  const double changes =
      (1 - std::exp(-dt / settings_.stays)) / kModels;  // into each of all models alike
  const Motions before = motion_;
  Weights expected{};
  for (std::size_t to = 0; to < kModels; ++to) {
    Weights from{};
    for (std::size_t m = 0; m < kModels; ++m)
      from[m] = belief_[m] * (m == to ? 1 - (kModels - 1) * changes : changes);
    for (const double w : from) expected[to] += w;
    for (double& w : from) w /= expected[to];
    motion_[to] = mixture(before, from);
  }
  belief_ = expected;
}

bool PoseFilter::isForeign(const Pose& X, const Matrix6& covariance, std::int64_t t_ns) const {
  if (!started_ || seconds(t_ns - t_ns_) > settings_.longest_gap) return false;
  return surprise(predicted(motion_.back(), settings_.models.back(),
                            seconds(std::max(t_ns - t_ns_, std::int64_t{0}))),
                  X, covariance) > kForeign;
}

PoseFilter::Taken PoseFilter::update(const Pose& X, const Matrix6& covariance, std::int64_t t_ns) {
  if (started_ && t_ns <= t_ns_) return Taken::left_out;
  const double dt = seconds(t_ns - t_ns_);
  if (!started_ || dt > settings_.longest_gap) {
    start(X, covariance, t_ns);
    return Taken::started_anew;
  }
  if (isForeign(X, covariance, t_ns)) {
    const bool jumped = outlier_ && (outlier_->X.translation() - X.translation()).norm() <
                                        kJumpSpeed * seconds(t_ns - outlier_->t_ns);
    if (jumped) {
      start(X, covariance, t_ns);
      return Taken::started_anew;
    }
    outlier_ = Outlier{X, t_ns};
    return Taken::left_out;
  }
  outlier_.reset();
  mix(dt);
  Weights fit{};
  for (std::size_t m = 0; m < kModels; ++m)
    motion_[m] = updated(predicted(motion_[m], settings_.models[m], dt), X, covariance, &fit[m]);
  const double best = *std::max_element(fit.begin(), fit.end());
  double sum = 0;
  for (std::size_t m = 0; m < kModels; ++m)
    sum += belief_[m] = std::max(belief_[m] * std::exp(fit[m] - best), 1e-12);
  for (double& b : belief_) b /= sum;
  mixed_ = mixture(motion_, belief_);
  t_ns_ = t_ns;
  return Taken::taken;
}

PoseMotion PoseFilter::at(std::int64_t t_ns) const {
  const double dt = std::max(seconds(t_ns - t_ns_), 0.0);
  if (dt == 0) return mixed_;
  Motions there;
  for (std::size_t m = 0; m < kModels; ++m)
    there[m] = predicted(motion_[m], settings_.models[m], dt);
  return mixture(there, belief_);
}

}  // namespace palpa::ar
