#include <algorithm>
#include <cmath>

#include "apps/calibrate/results.h"
#include "calibration/rotation.h"
#include "calibration/tool_tip.h"

namespace palpa::calibrate {
namespace {

constexpr double kTipSpread_mm = 0.25, kTipLeftOut_mm = 0.5, kNeedleSpread_deg = 0.5;
constexpr double kUnknownDirection = 2 * calibration::kDegree;
constexpr int kToolGoodFor_days = 90;
constexpr std::size_t kParts = 20;  // stretches of the recording; every fifth judges the fit

bool judges(std::size_t i, std::size_t n) { return (i * kParts / n) % 5 == 2; }

/// Rotation that takes z of `R` to `axis` by the shortest way.
Mat3 pointedAlong(const Mat3& R, const Vec3& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Vec3(R.col(2)), axis).toRotationMatrix() * R;
}

/// Where samples that the fit has not seen have their tip, against the hole.
double leftOutRms(const std::vector<Pose>& left_out, const calibration::TipCalibration& tip) {
  double squares = 0;
  for (const Pose& X : left_out) squares += (X * tip.tip_E - tip.pivot_D).squaredNorm();
  return left_out.empty() ? 0 : std::sqrt(squares / static_cast<double>(left_out.size()));
}

/// How much less a recording tells than as many independent samples would: neighbours share what is
/// wrong with the device. With r the correlation of neighbouring residuals the variance of a mean
/// is (1 + r) / (1 - r) times as large (first-order autoregression; Bartlett 1935).
double inflation(const std::vector<Pose>& samples, const calibration::TipCalibration& tip) {
  constexpr double kMostCorrelated = 0.99;
  double products = 0, squares = 0;
  Vec3 before = Vec3::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!tip.fit.good[i]) continue;
    const Vec3 off = samples[i] * tip.tip_E - tip.pivot_D;
    products += off.dot(before);
    squares += off.squaredNorm();
    before = off;
  }
  const double r = squares > 0 ? std::clamp(products / squares, 0.0, kMostCorrelated) : 0;
  return (1 + r) / (1 - r);
}

struct Split {
  std::vector<Pose> fitted, left_out;
  std::vector<std::size_t> place;  // of each fitted one among all
};

Split split(const std::vector<Pose>& all) {
  Split s;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool judge = all.size() >= 50 && judges(i, all.size());
    (judge ? s.left_out : s.fitted).push_back(all[i]);
    if (!judge) s.place.push_back(i);
  }
  return s;
}

// Of the turn about T's axes; about the needle itself it is 0.
Mat3 turnCovariance(const calibration::AxisCalibration& axis, const Mat3& R_ET) {
  const Eigen::Matrix<double, 3, 2> across_T = R_ET.transpose() * axis.across_E;
  Eigen::Matrix<double, 3, 2> turn = Eigen::Matrix<double, 3, 2>::Zero();
  turn.row(0) = -across_T.row(1);
  turn.row(1) = across_T.row(0);
  return turn * axis.covariance * turn.transpose();
}

void addDistances(Result& r, const std::vector<Pose>& fitted, const std::vector<std::size_t>& place,
                  const calibration::TipCalibration& tip) {
  Plot plot{"Distance of the tip from its hole", "sample", "mm", {}};
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const double off = (fitted[i] * tip.tip_E - tip.pivot_D).norm();
    r.file.residuals.values.push_back(off);
    if (!tip.fit.good[i]) r.file.residuals.left_out.push_back(static_cast<int>(i));
    plot.dots.push_back({static_cast<double>(place[i]), 1e3 * off, !tip.fit.good[i]});
  }
  r.plots.push_back(plot);
}

}  // namespace

Result toolResult(const ToolSamples& samples, const Pose& X_ET_design, const Origin& origin) {
  const auto [fitted, left_out, place] = split(samples.pivot);
  const calibration::TipCalibration tip = calibration::calibrateTip(fitted);
  Result r;
  r.title = "Needle tip";
  r.file = begun(origin, "tool", kToolGoodFor_days);
  Mat3 R = X_ET_design.rotation();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  covariance.bottomRightCorner<3, 3>() = inflation(fitted, tip) * tip.covariance;
  const double tip_sd = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  r.file.checks = {{"the tip's uncertainty", 1e3 * tip_sd, kTipSpread_mm, "mm"}};
  r.sentences = {"The tip lies " + quantity(1e3 * tip.tip_E.norm(), "mm") +
                 " from the handle's centre, known to " + quantity(1e3 * tip_sd, "mm") + "."};
  if (!left_out.empty())
    r.file.checks.push_back({"the tip's distance from its hole in samples not used",
                             1e3 * leftOutRms(left_out, tip), kTipLeftOut_mm, "mm"});
  if (samples.spin.empty()) {
    covariance(0, 0) = covariance(1, 1) = kUnknownDirection * kUnknownDirection;
    r.advice.push_back(
        "The needle's direction was not calibrated: it is taken from the station's file. Spin the "
        "needle in a hole to calibrate it.");
  } else {
    const calibration::AxisCalibration axis = calibration::calibrateAxis(samples.spin, R.col(2));
    R = pointedAlong(R, axis.axis_E);
    covariance.topLeftCorner<3, 3>() = turnCovariance(axis, R);
    const double axis_sd = std::sqrt(axis.covariance.trace()) / calibration::kDegree;
    r.file.checks.push_back(
        {"the uncertainty of the needle's direction", axis_sd, kNeedleSpread_deg, "degrees"});
    r.sentences.push_back("The needle's direction is known to " + quantity(axis_sd, "degrees") +
                          ".");
  }
  addPose(r.file, "X_ET", makePose(R, tip.tip_E));
  r.file.coordinates = {"turn_x_rad", "turn_y_rad", "turn_z_rad",
                        "shift_x_m",  "shift_y_m",  "shift_z_m"};
  r.file.covariance = covariance;
  r.file.residuals.unit = "m";
  r.file.residuals.rms = tip.rms;
  addDistances(r, fitted, place, tip);
  r.file.data.samples = static_cast<int>(samples.pivot.size() + samples.spin.size());
  r.file.data.used = static_cast<int>(fitted.size() + samples.spin.size()) - tip.fit.outliers();
  r.file.verdict = verdictOf(r.file.checks);
  r.advice.push_back("Redo it when the needle was changed, bent or dropped.");
  return r;
}

}  // namespace palpa::calibrate
