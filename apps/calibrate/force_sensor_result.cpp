#include <cmath>

#include "apps/calibrate/results.h"

namespace palpa::calibrate {
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
  r.file = begun(origin, "force-sensor", kForceSensorGoodFor_days);
  const auto numbers = [](const Vec3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  r.file.parameters = {{"bias_force_N", numbers(c.bias_f)},
                       {"bias_torque_Nm", numbers(c.bias_m)},
                       {"tool_mass_kg", {c.mass}},
                       {"tool_centre_m", numbers(c.centre_S)}};
  r.file.coordinates = {"bias_x_N",  "bias_y_N",     "bias_z_N",   "bias_x_Nm",  "bias_y_Nm",
                        "bias_z_Nm", "tool_mass_kg", "centre_x_m", "centre_y_m", "centre_z_m"};
  r.file.covariance = c.covariance;
  r.file.residuals = {"N", c.rms_f, {}, {}};
  Plot plot{"What bias and weight do not explain", "reading", "N", {}};
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
