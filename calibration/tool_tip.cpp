#include "calibration/tool_tip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kPivot[] = "pivot calibration", kSpin[] = "spin calibration";

std::string text(const char* format, double value) {
  char words[200];
  std::snprintf(words, sizeof words, format, value);
  return words;
}

void requirePoses(const std::vector<Pose>& poses, std::size_t least, const char* where) {
  if (poses.size() < least)
    throw Error(std::to_string(poses.size()) + " samples are too few, " + std::to_string(least) +
                    " are needed",
                where, "Record longer");
  for (const Pose& X : poses) requirePose(X, where);
}

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// (tip, pivot) of least squares.
Vec6 algebraicPivot(const std::vector<Pose>& poses) {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Vec6 b = Vec6::Zero();
  for (const Pose& X : poses) {
    Eigen::Matrix<double, 3, 6> rows;
    rows << X.linear(), -Mat3::Identity();
    A += rows.transpose() * rows;
    b -= rows.transpose() * X.translation();
  }
  return minimumNorm(A, b);
}

/// Residuals in E, along the lever and across it, each divided by its spread.
class PivotFit {
 public:
  PivotFit(const std::vector<Pose>& poses, Vec6 x) : poses_(poses), x_(std::move(x)) {
    turnTowardLever();
  }

  Fit run() {
    FitProblem problem{static_cast<int>(poses_.size()), 3, 6,
                       [this](const VectorX& dx) { return residuals(dx); },
                       [this](const VectorX& dx) { x_ += dx; }};
    Fit fit = robustFit(problem, kPivot);
    for (int i = 0; i < 3; ++i) {
      respread(fit);
      turnTowardLever();
      fit = robustFit(problem, kPivot);
    }
    return fit;
  }

  const Vec6& x() const { return x_; }
  /// rms of a good sample's distance from the pivot, m.
  double rms(const Fit& fit) const {
    double squares = 0;
    for (int i = 0; i < static_cast<int>(poses_.size()); ++i)
      if (fit.good[static_cast<std::size_t>(i)])
        squares += fit.r.segment<3>(3 * i).cwiseProduct(spread_).squaredNorm();
    return std::sqrt(squares / (static_cast<double>(poses_.size()) - fit.outliers()));
  }

 private:
  VectorX residuals(const VectorX& dx) const {
    const Vec6 x = x_ + dx;
    VectorX r(3 * poses_.size());
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Vec3 off_D = poses_[i] * Vec3(x.head<3>()) - x.tail<3>();
      r.segment<3>(static_cast<Eigen::Index>(3 * i)) =
          (to_lever_ * poses_[i].linear().transpose() * off_D).cwiseQuotient(spread_);
    }
    return r;
  }

  /// z along the lever.
  void turnTowardLever() {
    const Vec3 tip = x_.head<3>();
    to_lever_ = tip.norm() > 1e-6 ? Mat3(rotationWithZ(tip.normalized()).transpose())
                                  : Mat3(Mat3::Identity());
  }

  void respread(const Fit& fit) {
    double along = 0, across = 0;
    int count = 0;
    for (int i = 0; i < static_cast<int>(poses_.size()); ++i) {
      if (!fit.good[static_cast<std::size_t>(i)]) continue;
      const Vec3 r = fit.r.segment<3>(3 * i).cwiseProduct(spread_);
      along += r.z() * r.z();
      across += (r.x() * r.x() + r.y() * r.y()) / 2;
      ++count;
    }
    const double a = std::sqrt(along / count), c = std::sqrt(across / count),
                 least = 1e-3 * std::max(a, c) + 1e-6;
    spread_ = Vec3(std::max(c, least), std::max(c, least), std::max(a, least));
  }

  const std::vector<Pose>& poses_;
  Vec6 x_;
  Mat3 to_lever_ = Mat3::Identity();
  Vec3 spread_ = Vec3::Ones();
};

}  // namespace

TipCalibration calibrateTip(const std::vector<Pose>& X_DE, const TipLimits& limits) {
  requirePoses(X_DE, static_cast<std::size_t>(limits.least_samples), kPivot);
  TipCalibration tip;
  const LeastTilted tilts = leastTilted(X_DE);
  tip.least_spread = tilts.spread;
  PivotFit pivot(X_DE, algebraicPivot(X_DE));
  if (tilts.most < limits.least_spread)
    throw Error(text("the tool was hardly turned: by %.1f degrees rms", tilts.most / kDegree),
                kPivot, "Tilt it to every side by 20 degrees and more, the tip in its hole");
  if (tilts.spread < limits.least_spread) {
    char where[120];
    std::snprintf(where, sizeof where, "(%.2f, %.2f, %.2f)", tilts.axis.x(), tilts.axis.y(),
                  tilts.axis.z());
    throw Error(
        text("the tool was turned about one axis only: the tilt of that axis is %.1f degrees rms",
             tilts.spread / kDegree) +
            ", so how far the tip lies along " + where + " of the end effector cannot be known",
        kPivot,
        text("Tilt the tool to every side by 20 degrees and more (%.0f degrees rms are needed)",
             limits.least_spread / kDegree));
  }
  tip.fit = pivot.run();
  tip.tip_E = pivot.x().head<3>();
  tip.pivot_D = pivot.x().tail<3>();
  tip.covariance = tip.fit.covariance.topLeftCorner<3, 3>();
  for (int k = 0; k < 3; ++k) tip.half95[k] = tip.fit.halfWidth95(k);
  tip.rms = pivot.rms(tip.fit);
  const double worst = std::sqrt(symmetricEigen(tip.covariance).values[2]);
  if (tip.rms > limits.largest_rms)
    throw Error(text("the tip wandered: it is %.1f mm rms away from one place", 1e3 * tip.rms),
                kPivot,
                "Keep the tip in its hole while tilting; see that lengths are metres and poses are "
                "of the end effector in the base, not the other way");
  if (tip.tip_E.norm() > limits.longest)
    throw Error(
        text("the tip would be %.0f mm from the end effector's origin", 1e3 * tip.tip_E.norm()),
        kPivot,
        "See that lengths are metres, and that the poses are of the end effector in the base, not "
        "the other way (both ways pivot)");
  if (worst > limits.largest_sd)
    throw Error(text("the tip would be known to %.2f mm only", 1e3 * worst), kPivot,
                "Tilt farther, and record longer");
  return tip;
}

namespace {

Eigen::Matrix<double, 3, 2> acrossOf(const Vec3& axis) { return rotationWithZ(axis).leftCols<2>(); }

Vec3 tilted(const Vec3& axis, double a, double b) {
  return (axis + acrossOf(axis) * Eigen::Vector2d(a, b)).normalized();
}

/// Axis that the rotations leave where it is, and where: of the largest singular value of the mean
/// rotation.
struct Axes {
  Vec3 in_E, in_D;
};
Axes commonAxis(const std::vector<Pose>& poses) {
  Mat3 mean = Mat3::Zero();
  for (const Pose& X : poses) mean += X.linear();
  const SingularValues<3> singular = singularValues(mean);
  return {singular.V.col(0), singular.U.col(0)};
}

/// The smallest arc that holds every angle of the spin.
double arcSpun(const std::vector<Pose>& poses, const Axes& axes) {
  const Vec3 mark = acrossOf(axes.in_E).col(0);
  const Eigen::Matrix<double, 3, 2> across = acrossOf(axes.in_D);
  std::vector<double> angles;
  for (const Pose& X : poses) {
    const Eigen::Vector2d seen = across.transpose() * (X.linear() * mark);
    angles.push_back(std::atan2(seen.y(), seen.x()));
  }
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    widest = std::max(widest, angles[i] - angles[i - 1]);
  return 2 * std::numbers::pi - widest;
}

}  // namespace

AxisCalibration calibrateAxis(const std::vector<Pose>& X_DE, const Vec3& toward_E) {
  constexpr double kLeastArc = std::numbers::pi / 3, kLargestWander = 3 * kDegree;
  requirePoses(X_DE, 20, kSpin);
  Axes axes = commonAxis(X_DE);
  if (axes.in_E.dot(toward_E) < 0) axes = {-axes.in_E, -axes.in_D};
  AxisCalibration result;
  result.turned = arcSpun(X_DE, axes);
  if (result.turned < kLeastArc)
    throw Error(text("the needle was spun by %.0f degrees only", result.turned / kDegree), kSpin,
                "Spin it by half a turn or more");

  const auto residuals = [&](const VectorX& dx) {
    const Vec3 axis = tilted(axes.in_E, dx[0], dx[1]), direction = tilted(axes.in_D, dx[2], dx[3]);
    const Eigen::Matrix<double, 3, 2> across = acrossOf(axes.in_D);
    VectorX r(2 * X_DE.size());
    for (std::size_t i = 0; i < X_DE.size(); ++i)
      r.segment<2>(static_cast<Eigen::Index>(2 * i)) =
          across.transpose() * (X_DE[i].linear() * axis - direction);
    return r;
  };
  const auto move = [&](const VectorX& dx) {
    axes = {tilted(axes.in_E, dx[0], dx[1]), tilted(axes.in_D, dx[2], dx[3])};
  };
  result.fit = robustFit({static_cast<int>(X_DE.size()), 2, 4, residuals, move}, kSpin);
  result.axis_E = axes.in_E;
  result.direction_D = axes.in_D;
  result.across_E = acrossOf(axes.in_E);
  result.covariance = result.fit.covariance.topLeftCorner<2, 2>();
  result.rms = result.fit.rms;
  if (result.rms > kLargestWander)
    throw Error(text("the needle did not spin about itself: its axis wandered by %.1f degrees rms",
                     result.rms / kDegree),
                kSpin, "Hold it in a drill guide or a tight hole while spinning");
  return result;
}

}  // namespace palpa::calibration
