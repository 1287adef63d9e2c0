#include "anatomy/shapes/field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::anatomy {

double smoothMin(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double smoothMax(double a, double b, double k) { return -smoothMin(-a, -b, k); }

TubeField::TubeField(std::vector<Station> stations) : stations_(std::move(stations)) {}

double TubeField::operator()(const Vec3& p) const {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
    const Station &a = stations_[i], &b = stations_[i + 1];
    const Vec3 ab = b.p - a.p, ap = p - a.p;
    const double t = std::clamp(ap.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (ap - t * ab).norm() - (a.radius + t * (b.radius - a.radius)));
  }
  return best;
}

Vec3 gradient(const Field& field, const Vec3& p, double step) {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 d = step * Vec3::Unit(axis);
    g[axis] = (field(p + d) - field(p - d)) / (2 * step);
  }
  return g;
}

}  // namespace palpa::anatomy
