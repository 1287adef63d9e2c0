#include "apps/calibrate/results.h"

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
  r.file = begun(origin, "workspace", kWorkspaceGoodFor_days);
  const auto numbers = [](const Vec3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  r.file.parameters = {{"order", {static_cast<double>(map.order)}},
                       {"centre_m", numbers(map.centre_D)},
                       {"half_m", numbers(map.half_D)}};
  std::vector<double> coefficients;
  for (Eigen::Index i = 0; i < map.coefficients.rows(); ++i)
    for (Eigen::Index j = 0; j < 3; ++j) coefficients.push_back(map.coefficients(i, j));
  r.file.parameters.push_back({"coefficients_m", coefficients});
  Plot before{"Error at each point, before", "point", "mm", {}},
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

}  // namespace palpa::calibrate
