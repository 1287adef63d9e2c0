#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/calibrate/results.h"
#include "ar/tracking/board_pose.h"
#include "calibration/camera_calibration.h"

namespace palpa::calibrate {
namespace {

constexpr double kLeftOut_px = 0.7, kRms_px = 0.7, kFocalSpread_percent = 0.3;
constexpr std::size_t kViewsToJudge = 8;
constexpr int kCameraGoodFor_days = 180;
constexpr const char* kLensNames[] = {
    "focal_x_px", "focal_y_px", "centre_x_px", "centre_y_px", "k1", "k2", "p1", "p2", "k3"};

/// Squares and number of the errors of every other corner, the pose from the rest.
void judge(const calibration::BoardView& view, const calibration::CameraModel& camera,
           double* squares, int* n) {
  std::vector<ar::BoardPoint> half;
  for (std::size_t i = 0; i < view.p_W.size(); i += 2)
    half.push_back({view.p_W[i], view.pixels[i]});
  const auto pose = ar::estimateBoardPose(half, camera);
  if (!pose) return;
  for (std::size_t i = 1; i < view.p_W.size(); i += 2) {
    *squares += (camera.project(pose->X_CW * view.p_W[i]) - view.pixels[i]).squaredNorm();
    ++*n;
  }
}

/// Root of the mean squared error of corners in views that the lens has not seen; negative: too few
/// views to tell.
double leftOutRms_px(const std::vector<calibration::BoardView>& views, int width, int height,
                     bool keep_all) {
  if (views.size() < kViewsToJudge) return -1;
  std::vector<calibration::BoardView> fitted;
  for (std::size_t i = 0; i < views.size(); ++i)
    if (i % 5 != 4) fitted.push_back(views[i]);
  const calibration::CameraModel camera =
      calibration::calibrateCamera(fitted, width, height, {keep_all}).model;
  double squares = 0;
  int n = 0;
  for (std::size_t i = 4; i < views.size(); i += 5) judge(views[i], camera, &squares, &n);
  return n ? std::sqrt(squares / n) : -1;
}

/// "533.21 ± 0.40 px"
std::string withSpread(double value, double sd) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f ± %.2f px", value, sd);
  return text;
}

}  // namespace

Result cameraResult(const std::vector<calibration::BoardView>& views, int width, int height,
                    const Origin& origin, calibration::CameraModel* found, bool keep_all) {
  const calibration::CameraCalibration c =
      calibration::calibrateCamera(views, width, height, {keep_all});
  Result r;
  r.title = "Camera";
  r.file = begun(origin, station::CalibrationKind::camera, kCameraGoodFor_days);
  addCamera(r.file, c.model);
  r.file.coordinates.assign(std::begin(kLensNames), std::end(kLensNames));
  r.file.covariance = c.covariance;
  r.file.residuals = {"px", c.model.rms_px, {}, {}};
  MeasuredPlot plot{"How well each view fits", "view", "px", {}};
  for (std::size_t i = 0; i < c.views.size(); ++i) {
    plot.dots.push_back({static_cast<double>(i + 1), c.views[i].rms_px, !c.views[i].used});
    r.file.residuals.values.push_back(c.views[i].rms_px);
    if (!c.views[i].used) r.file.residuals.left_out.push_back(static_cast<int>(i));
    r.file.data.samples += static_cast<int>(views[i].p_W.size());
    if (c.views[i].used)
      r.file.data.used += static_cast<int>(views[i].p_W.size()) - c.views[i].outliers;
  }
  r.plots.push_back(plot);
  r.coverage.columns = static_cast<int>(calibration::kCoverageColumns);
  r.coverage.rows = static_cast<int>(calibration::kCoverageRows);
  for (const auto& row : c.coverage)
    r.coverage.counts.insert(r.coverage.counts.end(), row.begin(), row.end());
  const double focal_percent = 100 * std::max(c.sd[0] / c.model.fx, c.sd[1] / c.model.fy);
  r.file.checks = {{"the focal length's uncertainty", focal_percent, kFocalSpread_percent, "%"},
                   {"the corners' error", c.model.rms_px, kRms_px, "px"}};
  if (const double left_out = leftOutRms_px(views, width, height, keep_all); left_out >= 0)
    r.file.checks.push_back({"the corners' error in views not used", left_out, kLeftOut_px, "px"});
  else
    r.advice.push_back("With fewer than eight views nothing is left to judge by: take more.");
  r.sentences = {std::to_string(views.size()) + " views of the board; corners fit to " +
                     quantity(c.model.rms_px, "px") + ", seen in " +
                     quantity(100 * c.covered, "%") + " of the picture.",
                 "Focal length " + withSpread(c.model.fx, c.sd[0]) + " across, " +
                     withSpread(c.model.fy, c.sd[1]) + " down; centre " +
                     withSpread(c.model.cx, c.sd[2]) + ", " + withSpread(c.model.cy, c.sd[3]) +
                     "."};
  for (const std::string& warning : c.warnings) r.advice.push_back(warning);
  r.file.verdict = verdictOf(r.file.checks);
  r.advice.push_back("Redo it when the lens was turned, refocused or knocked.");
  *found = c.model;
  return r;
}

namespace {

constexpr double kOffsetSpread_ms = 1.0, kHalvesApart_ms = 3.0;
constexpr int kLatencyGoodFor_days = 180;

/// The offset that a part of the camera's recording tells.
double offsetOf(const LatencySamples& samples, std::size_t from, std::size_t to, double t) {
  const std::vector<calibration::TimedPoint> part(
      samples.camera.begin() + static_cast<std::ptrdiff_t>(from),
      samples.camera.begin() + static_cast<std::ptrdiff_t>(to));
  const calibration::ClockOffset fit = calibration::estimateClockOffset(part, samples.device);
  return fit.offset + fit.drift * (t - fit.t_middle);
}

}  // namespace

Result latencyResult(const LatencySamples& samples, double camera_latency_s, const Origin& origin) {
  const calibration::ClockOffset fit =
      calibration::estimateClockOffset(samples.camera, samples.device);
  Result r;
  r.title = "Time between camera and device";
  r.file = begun(origin, station::CalibrationKind::latency, kLatencyGoodFor_days);
  r.file.parameters = {{"offset_s", {fit.offset}},
                       {"drift_s_per_s", {fit.drift}},
                       {"at_s", {fit.t_middle}},
                       {"camera_latency_s", {camera_latency_s - fit.offset}}};
  r.file.coordinates = {"offset_s", "drift_s_per_s"};
  r.file.covariance =
      Eigen::Vector2d(fit.offset_sd * fit.offset_sd, fit.drift_sd * fit.drift_sd).asDiagonal();
  r.file.residuals = {"m", fit.rms, {}, {}};
  r.file.checks = {{"the offset's uncertainty", 1e3 * fit.offset_sd, kOffsetSpread_ms, "ms"}};
  const std::size_t n = samples.camera.size();
  if (n >= 140) {  // each half long enough for an answer of its own
    const double first = offsetOf(samples, 0, n / 2, fit.t_middle),
                 second = offsetOf(samples, n / 2, n, fit.t_middle);
    r.file.checks.push_back({"the difference between the recording's halves",
                             1e3 * std::abs(first - second), kHalvesApart_ms, "ms"});
  }
  r.sentences = {"The camera's pictures are " +
                     quantity(1e3 * (camera_latency_s - fit.offset), "ms") +
                     " old when they arrive, known to " + quantity(1e3 * fit.offset_sd, "ms") + ".",
                 "The clocks drift apart by " + quantity(1e6 * fit.drift, "microseconds a second") +
                     " (known to " + quantity(1e6 * fit.drift_sd, "") + ")."};
  MeasuredPlot plot{"Camera against device, after the shift in time", "s", "mm", {}};
  const int size =
      static_cast<int>(fit.fit.r.size() / static_cast<Eigen::Index>(std::max<std::size_t>(n, 1)));
  for (std::size_t i = 0; i < fit.fit.good.size() && i < n && size > 0; ++i) {
    const double off = fit.fit.r.segment(static_cast<Eigen::Index>(i) * size, size).norm();
    r.file.residuals.values.push_back(off);
    if (!fit.fit.good[i]) r.file.residuals.left_out.push_back(static_cast<int>(i));
    plot.dots.push_back({samples.camera[i].t, 1e3 * off, !fit.fit.good[i]});
  }
  r.plots.push_back(plot);
  r.file.data.samples = static_cast<int>(n);
  r.file.data.used = static_cast<int>(n) - fit.fit.outliers();
  r.file.verdict = verdictOf(r.file.checks);
  r.advice.push_back("Redo it when the camera, its frame rate or the computer was changed.");
  return r;
}

}  // namespace palpa::calibrate
