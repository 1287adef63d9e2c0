#include "apps/assess/metrics/curve_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::metrics {
namespace {

constexpr double kNoCurve = std::numeric_limits<double>::quiet_NaN(),
                 kFar = std::numeric_limits<double>::infinity();

double farthest(const Curve& a, const Curve& b) {
  double most = 0;
  for (const Vec3& p : a) {
    double nearest = kFar;
    for (const Vec3& q : b) nearest = std::min(nearest, (p - q).squaredNorm());
    most = std::max(most, nearest);
  }
  return std::sqrt(most);
}

/// A cell of the alignment's table: its cost and how many pairs led there.
struct AlignmentCell {
  double cost = kFar;
  int pairs = 0;
};

}  // namespace

Curve resampled(const Curve& curve, int points) {
  if (curve.size() < 2) return curve;
  std::vector<double> at{0};
  for (std::size_t i = 1; i < curve.size(); ++i)
    at.push_back(at.back() + (curve[i] - curve[i - 1]).norm());
  if (!(at.back() > 0)) return {curve.front()};
  Curve even;
  std::size_t i = 1;
  for (int k = 0; k < points; ++k) {
    const double wanted = at.back() * k / (points - 1);
    while (i + 1 < curve.size() && at[i] < wanted) ++i;
    const double length = at[i] - at[i - 1],
                 share = length > 0 ? std::clamp((wanted - at[i - 1]) / length, 0.0, 1.0) : 0;
    even.push_back(curve[i - 1] + share * (curve[i] - curve[i - 1]));
  }
  return even;
}

double hausdorff(const Curve& one, const Curve& other) {
  if (one.empty() || other.empty()) return kNoCurve;
  const Curve a = resampled(one), b = resampled(other);
  return std::max(farthest(a, b), farthest(b, a));
}

double frechet(const Curve& one, const Curve& other) {
  if (one.empty() || other.empty()) return kNoCurve;
  const Curve a = resampled(one), b = resampled(other);
  std::vector<double> before(b.size(), kFar), row(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double here = (a[i] - b[j]).norm();
      const double reached =
          std::min({before[j], j > 0 ? before[j - 1] : kFar, j > 0 ? row[j - 1] : kFar});
      row[j] = i == 0 && j == 0 ? here : std::max(here, reached);
    }
    before.swap(row);
  }
  return before.back();
}

double timeWarped(const Curve& one, const Curve& other) {
  if (one.empty() || other.empty()) return kNoCurve;
  const Curve a = resampled(one), b = resampled(other);
  std::vector<AlignmentCell> before(b.size()), row(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      AlignmentCell best = i == 0 && j == 0 ? AlignmentCell{0, 0} : before[j];
      if (j > 0)
        for (const AlignmentCell& from : {before[j - 1], row[j - 1]})
          if (from.cost < best.cost) best = from;
      row[j] = {best.cost + (a[i] - b[j]).norm(), best.pairs + 1};
    }
    before.swap(row);
  }
  return before.back().cost / before.back().pairs;
}

}  // namespace palpa::metrics
