#include "calibration/registration.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kWorkspace[] = "workspace calibration";
constexpr int kHighestOrder = 3;
constexpr double kBetter = 0.95;
constexpr double kMostOutliers = 0.3, kMostBeforeCorrection = 0.9;
constexpr std::size_t kLeastPoints = 12;

int monomials(int order) { return (order + 1) * (order + 2) * (order + 3) / 6; }

VectorX phi(const Vec3& q, int order) {
  VectorX values(monomials(order));
  Eigen::Index at = 0;
  for (int degree = 0; degree <= order; ++degree)
    for (int i = degree; i >= 0; --i)
      for (int j = degree - i; j >= 0; --j)
        values[at++] = std::pow(q.x(), i) * std::pow(q.y(), j) * std::pow(q.z(), degree - i - j);
  return values;
}

Vec3 scaled(const WorkspaceMap& map, const Vec3& p_D) {
  return (p_D - map.centre_D).cwiseQuotient(map.half_D);
}

void measureBox(const std::vector<TouchedPoint>& points, WorkspaceMap* map) {
  Eigen::AlignedBox3d box;
  for (const TouchedPoint& p : points) box.extend(Vec3(p.p_D - p.lever_D));
  map->centre_D = box.center();
  map->half_D = (box.sizes() / 2).cwiseMax(1e-3);
}

/// Of a device that is to be put right many points may miss a rigid motion: no reason to refuse
/// yet.
LandmarkRegistration rigid(const std::vector<TouchedPoint>& points, double most_outliers) {
  std::vector<TouchedLandmark> landmarks;
  for (const TouchedPoint& p : points) landmarks.push_back({p.p_D, p.p_G, 1e-3});
  return registerLandmarks(landmarks, 0.02, most_outliers);
}

/// The map from D to the grid: G = coefficients' phi, linear; robust. The rigid motion nearest to
/// it becomes X_GD.
void fitPolynomial(const std::vector<TouchedPoint>& points, const Pose& X_GD, WorkspaceMap* map) {
  const int terms = monomials(map->order), parameters = 3 * terms;
  std::vector<VectorX> values;
  for (const TouchedPoint& p : points)
    values.push_back(phi(scaled(*map, p.p_D - p.lever_D), map->order));
  VectorX x = VectorX::Zero(parameters);  // term by term, of what is beside the rigid motion, in G
  const auto residuals = [&](const VectorX& dx) {
    const VectorX y = x + dx;
    VectorX r(3 * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec3 off = X_GD * points[i].p_D - points[i].p_G;
      for (int k = 0; k < terms; ++k) off += values[i][k] * y.segment<3>(3 * k);
      r.segment<3>(static_cast<Eigen::Index>(3 * i)) = off;
    }
    return r;
  };
  map->fit = robustFit({static_cast<int>(points.size()), 3, parameters, residuals,
                        [&](const VectorX& dx) { x += dx; }},
                       kWorkspace, kMostOutliers, 1e-4);
  map->coefficients.resize(terms, 3);
  for (int k = 0; k < terms; ++k)
    map->coefficients.row(k) = (X_GD.linear().transpose() * x.segment<3>(3 * k)).transpose();
}

double rmsOf(const std::vector<TouchedPoint>& points, const WorkspaceMap& map, bool corrected,
             const std::vector<bool>& which) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!which[i]) continue;
    const Vec3 off =
        corrected ? map.correction(points[i].p_D - points[i].lever_D) : Vec3(Vec3::Zero());
    squares += (map.X_GD * Vec3(points[i].p_D + off) - points[i].p_G).squaredNorm();
    ++count;
  }
  return std::sqrt(squares / count);
}

WorkspaceMap fitted(const std::vector<TouchedPoint>& points, int order) {
  WorkspaceMap map;
  map.order = order;
  measureBox(points, &map);
  const LandmarkRegistration registration =
      rigid(points, order == 0 ? kMostOutliers : kMostBeforeCorrection);
  map.X_GD = registration.X_BA;
  if (order == 0) {
    map.fit = registration.fit;
    map.coefficients = MatrixX::Zero(1, 3);
  } else {
    fitPolynomial(points, map.X_GD, &map);
  }
  map.rms_before = rmsOf(points, map, false, map.fit.good);
  map.rms_after = rmsOf(points, map, true, map.fit.good);
  return map;
}

/// rms before and after at each fifth of the good points, by what the others say.
void leaveOut(const std::vector<TouchedPoint>& points, WorkspaceMap* map) {
  constexpr std::size_t kParts = 5;
  double before = 0, after = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    std::vector<TouchedPoint> others;
    std::vector<bool> which(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      which[i] = i % kParts == part && map->fit.good[i];
      if (i % kParts != part && map->fit.good[i]) others.push_back(points[i]);
    }
    const WorkspaceMap other = fitted(others, map->order);
    before += std::pow(rmsOf(points, other, false, which), 2) / kParts;
    after += std::pow(rmsOf(points, other, true, which), 2) / kParts;
  }
  map->left_out_before = std::sqrt(before);
  map->left_out_after = std::sqrt(after);
}

void requirePoints(const std::vector<TouchedPoint>& points) {
  if (points.size() < kLeastPoints)
    throw Error(std::to_string(points.size()) + " points are too few", kWorkspace,
                "Touch a grid of 3 x 3 x 3 or more");
  Vec3 mean = Vec3::Zero();
  for (const TouchedPoint& p : points) {
    if (!p.p_G.allFinite() || !p.p_D.allFinite())
      throw Error("a point is not a number", kWorkspace, "Touch it again");
    mean += p.p_D / static_cast<double>(points.size());
  }
  Mat3 spread = Mat3::Zero();
  for (const TouchedPoint& p : points)
    spread += (p.p_D - mean) * (p.p_D - mean).transpose() / static_cast<double>(points.size());
  const Vec3 sizes = symmetricEigen(spread).values.cwiseMax(0).cwiseSqrt();
  if (sizes[0] < 0.1 * sizes[2])
    throw Error("the points lie in one plane: above and below it nothing would be known",
                kWorkspace, "Touch the grid at two heights more");
}

}  // namespace

Vec3 WorkspaceMap::correction(const Vec3& p_D) const {
  return coefficients.transpose() * phi(scaled(*this, p_D), order);
}

Mat3 WorkspaceMap::covarianceAt(const Vec3& p_D) const {
  if (order == 0) {
    Eigen::Matrix<double, 3, 6> J;
    J << -X_GD.linear() * crossMatrix(p_D - centre_D), Mat3::Identity();
    return J * fit.covariance * J.transpose();
  }
  const VectorX values = phi(scaled(*this, p_D), order);
  MatrixX J(3, 3 * values.size());
  for (Eigen::Index k = 0; k < values.size(); ++k)
    J.middleCols<3>(3 * k) = values[k] * Mat3::Identity();
  return J * fit.covariance * J.transpose();
}

WorkspaceMap mapWorkspace(const std::vector<TouchedPoint>& points, int order) {
  requirePoints(points);
  WorkspaceMap map = fitted(points, order);
  leaveOut(points, &map);
  return map;
}

WorkspaceMap mapWorkspace(const std::vector<TouchedPoint>& points) {
  requirePoints(points);
  std::optional<WorkspaceMap> best;
  for (int order = 0; order <= kHighestOrder; ++order) {
    if (order > 0 && static_cast<std::size_t>(monomials(order)) * 3 / 2 > points.size())
      break;  // enough to spare
    try {
      WorkspaceMap map = mapWorkspace(points, order);
      if (!best || map.left_out_after < kBetter * best->left_out_after) best = std::move(map);
    } catch (const Error&) {
      continue;  // a low order may miss too many points of a device that a higher one puts right
    }
  }
  return best ? *best : mapWorkspace(points, 0);  // which says why not
}

}  // namespace palpa::calibration
