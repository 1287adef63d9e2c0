#include <algorithm>
#include <cmath>

#include "apps/calibrate/results.h"

namespace palpa::calibrate {
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
  r.file = begun(origin, "latency", kLatencyGoodFor_days);
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
  Plot plot{"Camera against device, after the shift in time", "s", "mm", {}};
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
