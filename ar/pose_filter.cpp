#include "ar/pose_filter.h"

#include <algorithm>
#include <cmath>

namespace palpa::ar {
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
