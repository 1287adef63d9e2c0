#include <algorithm>
#include <cmath>

#include "apps/calibrate/results.h"
#include "calibration/rotation.h"
#include "calibration/tool_tip.h"

namespace palpa::calibrate {
namespace {

constexpr double kGridLeftOut_mm = 0.8;
constexpr int kWorkspaceGoodFor_days = 180;

}  // namespace

Result workspaceResult(const std::vector<Touch>& touches, const Origin& origin,
                       calibration::WorkspaceMap* found) {
  std::vector<calibration::TouchedPoint> points;
  for (const Touch& t : touches) points.push_back({t.p_W, t.p_D, t.lever_D});
  const calibration::WorkspaceMap map = calibration::mapWorkspace(points);
  Result r;
  r.title = "The device's workspace";
  r.file = begun(origin, station::CalibrationKind::workspace, kWorkspaceGoodFor_days);
  const auto numbers = [](const Vec3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  r.file.parameters = {{"order", {static_cast<double>(map.order)}},
                       {"centre_m", numbers(map.centre_D)},
                       {"half_m", numbers(map.half_D)}};
  std::vector<double> coefficients;
  for (Eigen::Index i = 0; i < map.coefficients.rows(); ++i)
    for (Eigen::Index j = 0; j < 3; ++j) coefficients.push_back(map.coefficients(i, j));
  r.file.parameters.push_back({"coefficients_m", coefficients});
  MeasuredPlot before{"Error at each point, before", "point", "mm", {}},
      after{"Error at each point, corrected", "point", "mm", {}};
  const calibration::WorkspaceMap rigid = calibration::mapWorkspace(points, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off =
        (map.X_GD * Vec3(points[i].p_D + map.correction(points[i].p_D - points[i].lever_D)) -
         points[i].p_G)
            .norm();
    before.dots.push_back({static_cast<double>(i + 1),
                           1e3 * (rigid.X_GD * points[i].p_D - points[i].p_G).norm(), false});
    after.dots.push_back({static_cast<double>(i + 1), 1e3 * off, !map.fit.good[i]});
    r.file.residuals.values.push_back(off);
    if (!map.fit.good[i]) r.file.residuals.left_out.push_back(static_cast<int>(i));
  }
  r.plots = {before, after};
  r.file.residuals.unit = "m";
  r.file.residuals.rms = map.rms_after;
  r.file.checks = {
      {"the error at points not used", 1e3 * map.left_out_after, kGridLeftOut_mm, "mm"}};
  r.sentences = {
      map.order == 0
          ? "The device is right as it is: no correction makes points that were not used better."
          : "A correction of order " + std::to_string(map.order) +
                " brings the error at points that were not used from " +
                quantity(1e3 * map.left_out_before, "mm") + " to " +
                quantity(1e3 * map.left_out_after, "mm") + "."};
  r.file.coordinates = {};
  r.file.data.samples = static_cast<int>(points.size());
  r.file.data.used = static_cast<int>(points.size()) - map.fit.outliers();
  r.file.verdict = verdictOf(r.file.checks);
  r.advice.push_back("Redo it when the device was repaired or its homing changed.");
  if (found) *found = map;
  return r;
}

namespace {

constexpr double kTipSpread_mm = 0.25, kTipLeftOut_mm = 0.5, kNeedleSpread_deg = 0.5;
constexpr double kUnknownDirection = 2 * kDegree;
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
  MeasuredPlot plot{"Distance of the tip from its hole", "sample", "mm", {}};
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
  r.file = begun(origin, station::CalibrationKind::tool, kToolGoodFor_days);
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
    const double axis_sd = std::sqrt(axis.covariance.trace()) / kDegree;
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

namespace {

constexpr double kForceLeftOver_N = 0.05, kCrossTalk_percent = 2;
constexpr int kForceSensorGoodFor_days = 30;

/// What readings that the fit has not seen show beyond bias and weight, N rms.
double leftOver(const calibration::ForceSensorCalibration& c,
                const std::vector<calibration::StaticReading>& readings, const Vec3& down_D) {
  double squares = 0;
  for (const auto& reading : readings)
    squares += (reading.f_S - c.bias_f - c.mass * 9.80665 * (reading.R_DS.transpose() * down_D))
                   .squaredNorm();
  return std::sqrt(squares / static_cast<double>(readings.size()));
}

}  // namespace

Result forceSensorResult(const std::vector<calibration::StaticReading>& readings,
                         const Vec3& down_D, const Origin& origin) {
  std::vector<calibration::StaticReading> fitted, left_out;
  for (std::size_t i = 0; i < readings.size(); ++i)
    (readings.size() >= 10 && i % 5 == 4 ? left_out : fitted).push_back(readings[i]);
  const calibration::ForceSensorCalibration c = calibration::calibrateForceSensor(fitted, down_D);
  Result r;
  r.title = "Force sensor";
  r.file = begun(origin, station::CalibrationKind::force_sensor, kForceSensorGoodFor_days);
  const auto numbers = [](const Vec3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  r.file.parameters = {{"bias_force_N", numbers(c.bias_f)},
                       {"bias_torque_Nm", numbers(c.bias_m)},
                       {"tool_mass_kg", {c.mass}},
                       {"tool_centre_m", numbers(c.centre_S)}};
  r.file.coordinates = {"bias_x_N",  "bias_y_N",     "bias_z_N",   "bias_x_Nm",  "bias_y_Nm",
                        "bias_z_Nm", "tool_mass_kg", "centre_x_m", "centre_y_m", "centre_z_m"};
  r.file.covariance = c.covariance;
  r.file.residuals = {"N", c.rms_f, {}, {}};
  MeasuredPlot plot{"What bias and weight do not explain", "reading", "N", {}};
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const double off = leftOver(c, {fitted[i]}, down_D);
    r.file.residuals.values.push_back(off);
    if (!c.fit.good[i]) r.file.residuals.left_out.push_back(static_cast<int>(i));
    plot.dots.push_back({static_cast<double>(i + 1), off, !c.fit.good[i]});
  }
  r.plots.push_back(plot);
  if (!left_out.empty())
    r.file.checks.push_back({"force left over in readings not used", leftOver(c, left_out, down_D),
                             kForceLeftOver_N, "N"});
  if (c.cross_talk_found)
    r.file.checks.push_back({"cross-talk between the force's directions",
                             100 * (c.cross_talk - Mat3::Identity()).cwiseAbs().maxCoeff(),
                             kCrossTalk_percent, "%"});
  r.sentences = {"The tool weighs " + quantity(1e3 * c.mass, "g") +
                 "; untouched, the sensor shows " + quantity(c.bias_f.norm(), "N") +
                 " that are not there, which is taken off from now on."};
  r.file.data.samples = static_cast<int>(readings.size());
  r.file.data.used = static_cast<int>(fitted.size()) - c.fit.outliers();
  r.file.verdict = verdictOf(r.file.checks);
  r.advice.push_back("Redo it when the tool was changed, and after the sensor has warmed up.");
  return r;
}

}  // namespace palpa::calibrate
