#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "apps/calibrate/results.h"
#include "calibration/registration.h"
#include "calibration/rotation.h"

namespace palpa::calibrate {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr double kTargetError_mm = 0.8, kDisagreement_mm = 1.5, kTagLeftOut_px = 1.5;
constexpr double kChi2_6_999 = 22.46;  // 99.9 % quantile, six degrees of freedom
constexpr int kRegistrationGoodFor_days = 30;
constexpr double kTouchSpread = 5e-4;  // m; only its ratio between landmarks matters

/// The device's base in W's inverse: X_DW with the covariance of (turn in W, shift in D).
struct BaseEstimate {
  Pose X_DW = Pose::Identity();
  Matrix6 covariance = Matrix6::Zero();
};

/// What moves a to b, as `moved` takes it.
Vector6 difference(const Pose& a, const Pose& b) {
  Vector6 d;
  d << calibration::rotationVector(a.rotation().transpose() * b.rotation()),
      b.translation() - a.translation();
  return d;
}

double chi2(const BaseEstimate& a, const BaseEstimate& b) {
  const Vector6 d = difference(a.X_DW, b.X_DW);
  return d.dot((a.covariance + b.covariance).ldlt().solve(d));
}

/// The best of both, weighted by what each knows.
BaseEstimate joined(const BaseEstimate& a, const BaseEstimate& b) {
  const Matrix6 of_a = a.covariance.inverse(), of_b = b.covariance.inverse();
  BaseEstimate both;
  both.covariance = (of_a + of_b).inverse();
  both.covariance = 0.5 * (both.covariance + both.covariance.transpose()).eval();
  both.X_DW =
      calibration::moved(a.X_DW, Vector6(both.covariance * (of_b * difference(a.X_DW, b.X_DW))));
  return both;
}

double rmsAt(const std::vector<Touch>& touches, const Pose& X_WD) {
  double squares = 0;
  int n = 0;
  for (const Touch& t : touches) {
    if (!t.for_check) continue;
    squares += (X_WD * t.p_D - t.p_W).squaredNorm();
    ++n;
  }
  return n ? std::sqrt(squares / n) : -1;
}

BaseEstimate byLandmarks(const std::vector<Touch>& touches, Result& r) {
  std::vector<calibration::TouchedLandmark> landmarks;
  std::vector<std::string> names;
  for (const Touch& t : touches)
    if (!t.for_check) {
      landmarks.push_back({t.p_W, t.p_D, kTouchSpread});
      names.push_back(t.name);
    }
  const calibration::LandmarkRegistration fit = calibration::registerLandmarks(landmarks);
  MeasuredPlot plot{"How well each landmark fits", "landmark", "mm", {}};
  std::string wrong;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const double off = (fit.X_BA * landmarks[i].p_A - landmarks[i].p_B).norm();
    plot.dots.push_back({static_cast<double>(i + 1), 1e3 * off, !fit.fit.good[i]});
    r.file.residuals.values.push_back(off);
    if (fit.fit.good[i]) continue;
    r.file.residuals.left_out.push_back(static_cast<int>(i));
    wrong += (wrong.empty() ? "" : ", ") + names[i];
  }
  r.plots.push_back(plot);
  r.file.residuals.unit = "m";
  r.file.residuals.rms = fit.fre;
  r.file.data.samples += static_cast<int>(landmarks.size());
  r.file.data.used += static_cast<int>(landmarks.size()) - fit.fit.outliers();
  r.sentences.push_back(std::to_string(landmarks.size()) + " landmarks were touched; they fit to " +
                        quantity(1e3 * fit.fre, "mm") + ".");
  if (!wrong.empty())
    r.advice.push_back("Left out, because they do not fit the others: " + wrong +
                       ". Were they touched in the right place?");
  return {fit.X_BA, fit.covariance};
}

/// How large the seen motions of the marker are against the device's: the median over pairs of
/// poses that are well apart.
double seenScale(const std::vector<calibration::HandEyeSample>& tag, const Vec3& p_EM) {
  constexpr double kApart = 0.03;  // m
  std::vector<double> ratios;
  for (std::size_t i = 0; i < tag.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double device = (tag[i].X_DE * p_EM - tag[j].X_DE * p_EM).norm();
      if (device > kApart)
        ratios.push_back((tag[i].X_CM.translation() - tag[j].X_CM.translation()).norm() / device);
    }
  if (ratios.empty()) return 1;
  return upperMedian(std::move(ratios));
}

/// A board or tag that is not as large as stated makes every distance wrong alike.
void requireScale(const std::vector<calibration::HandEyeSample>& tag, const Vec3& p_EM) {
  constexpr double kScaleOff = 0.02;
  const double scale = seenScale(tag, p_EM);
  if (std::abs(scale - 1) > kScaleOff)
    throw Error("the camera sees the tool move " + quantity(100 * (scale - 1), "%") +
                    " further than the device reports",
                "registration by a tag",
                "Measure the printed squares or tags of board and marker, and correct their size "
                "in the station's file");
}

void addPosePlot(const std::vector<calibration::HandEyeSample>& tag,
                 const calibration::HandEye& fit, Result& r) {
  r.file.residuals.unit = "m";
  r.file.residuals.rms = fit.rms_shift;
  MeasuredPlot plot{"How well each pose fits", "pose", "mm", {}};
  for (std::size_t i = 0; i < tag.size(); ++i) {
    const double off =
        (fit.X_DC.inverse() * (tag[i].X_DE * fit.X_EM.translation()) - tag[i].X_CM.translation())
            .norm();
    plot.dots.push_back({static_cast<double>(i + 1), 1e3 * off, !fit.fit.good[i]});
    r.file.residuals.values.push_back(off);
    if (!fit.fit.good[i]) r.file.residuals.left_out.push_back(static_cast<int>(i));
  }
  r.plots.push_back(plot);
}

BaseEstimate byTag(const TagSamples& tag, Result& r) {
  const calibration::HandEye fit = calibration::calibrateHandEye(tag.poses);
  requireScale(tag.poses, fit.X_EM.translation());
  r.file.data.samples += static_cast<int>(tag.poses.size());
  r.file.data.used += static_cast<int>(tag.poses.size()) - fit.fit.outliers();
  r.sentences.push_back("The tag on the tool was seen in " + std::to_string(tag.poses.size()) +
                        " poses; in poses not used it is predicted to " +
                        quantity(1e3 * fit.left_out_shift, "mm") + ".");
  if (r.file.residuals.values.empty()) addPosePlot(tag.poses, fit, r);
  if (tag.views.empty()) {
    addPose(r.file, "X_EM", fit.X_EM);
    return {fit.X_DC, fit.covariance.bottomRightCorner<6, 6>()};
  }
  const calibration::RefinedHandEye refined =
      calibration::refineHandEye(tag.views, tag.poses, tag.camera);
  // Corners tell more where the picture's noise is the larger part, poses where the hand's tremble
  // is: poses that neither has seen decide.
  const bool corners = refined.left_out_px < refined.left_out_start_px;
  addPose(r.file, "X_EM", corners ? refined.X_EM : fit.X_EM);
  const double left_out = std::min(refined.left_out_px, refined.left_out_start_px);
  r.file.checks.push_back(
      {"the error of the tag's corners in poses not used", left_out, kTagLeftOut_px, "px"});
  r.sentences.push_back(
      "In poses not used the tag's corners are predicted to " + quantity(left_out, "px") +
      (corners ? ", fitted to the corners themselves (by the poses: "
               : ", fitted to the tag's poses (by the corners: ") +
      quantity(std::max(refined.left_out_px, refined.left_out_start_px), "px") + ").");
  return corners ? BaseEstimate{refined.X_DW, refined.covariance.bottomRightCorner<6, 6>()}
                 : BaseEstimate{fit.X_DC, fit.covariance.bottomRightCorner<6, 6>()};
}

/// Where the board, or whatever the tag was seen from, stands in the device's base.
std::string inDevice(const Pose& X_DW, bool by_tag_alone) {
  const Vec3 p = X_DW.translation(), euler = X_DW.rotation().eulerAngles(0, 1, 2);
  char words[200];
  std::snprintf(words, sizeof words,
                "In the device's base %s stands at %.4f, %.4f, %.4f m, turned by the Euler angles "
                "x, y, z: %.4f, %.4f, %.4f rad.",
                by_tag_alone ? "what the tag was seen from" : "the board", p.x(), p.y(), p.z(),
                euler.x(), euler.y(), euler.z());
  return words;
}

}  // namespace

Result registrationResult(const std::vector<Touch>& touches, const TagSamples& tag,
                          const Vec3& tip_W, const Origin& origin) {
  Result r;
  r.title = "Device and board (registration)";
  r.file = begun(origin, station::CalibrationKind::registration, kRegistrationGoodFor_days);
  BaseEstimate answer;
  if (!touches.empty() && !tag.poses.empty()) {
    const BaseEstimate by_landmarks = byLandmarks(touches, r), by_tag = byTag(tag, r);
    const Vec3 apart = by_landmarks.X_DW * tip_W - by_tag.X_DW * tip_W;
    const double chi = chi2(by_landmarks, by_tag);
    r.file.checks.push_back({"the difference between landmarks and tag at the needle's tip",
                             1e3 * apart.norm(), kDisagreement_mm, "mm"});
    r.sentences.push_back(
        "Landmarks and tag, which do not know of each other, agree at the needle's tip to " +
        quantity(1e3 * apart.norm(), "mm") + ".");
    const bool agree = chi < kChi2_6_999;
    answer = agree ? joined(by_landmarks, by_tag) : by_landmarks;
    if (!agree)
      r.advice.push_back(
          "They differ by more than their spreads explain: the landmarks alone are used. Is the "
          "camera's calibration of this lens and focus?");
  } else {
    answer = touches.empty() ? byTag(tag, r) : byLandmarks(touches, r);
  }
  const Pose X_WD = answer.X_DW.inverse();
  r.sentences.push_back(inDevice(answer.X_DW, touches.empty()));
  addPose(r.file, "X_WD", X_WD);
  r.file.coordinates = {"turn_x_rad", "turn_y_rad", "turn_z_rad",
                        "shift_x_m",  "shift_y_m",  "shift_z_m"};
  r.file.covariance = calibration::inverseCovariance(answer.X_DW, answer.covariance);
  const double predicted =
      std::sqrt(calibration::pointCovariance(answer.X_DW, answer.covariance, tip_W).trace());
  r.file.parameters.push_back({"predicted_error_at_tip_m", {predicted}});
  r.file.checks.push_back(
      {"the error predicted at the needle's tip", 1e3 * predicted, kTargetError_mm, "mm"});
  r.sentences.push_back("At the needle's tip the overlay is expected to be off by " +
                        quantity(1e3 * predicted, "mm") + ".");
  if (const double left_out = rmsAt(touches, X_WD); left_out >= 0) {
    r.file.checks.push_back(
        {"the error at landmarks not used", 1e3 * left_out, kTargetError_mm, "mm"});
    r.sentences.push_back("At landmarks that were not used the error is " +
                          quantity(1e3 * left_out, "mm") + ".");
  } else {
    r.advice.push_back("No landmark was kept for a check: mark some of them as \"check\".");
  }
  r.file.verdict = verdictOf(r.file.checks);
  r.advice.push_back("Redo it when the device, the board or the table was moved.");
  return r;
}

}  // namespace palpa::calibrate
