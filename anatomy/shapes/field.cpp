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

TubeField::TubeField(std::vector<Station> stations) : stations_(std::move(stations)) {
  constexpr std::size_t kBundle = 8;
  for (const Station& s : stations_) {
    box_.extend(Vec3(s.p.array() - s.radius));
    box_.extend(Vec3(s.p.array() + s.radius));
  }
  for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
    const Station &a = stations_[i], &b = stations_[i + 1];
    const Vec3 ab = b.p - a.p;
    spans_.push_back({a.p, ab / ab.squaredNorm(), ab, a.radius, b.radius - a.radius});
  }
  for (std::size_t begin = 0; begin < spans_.size(); begin += kBundle) {
    const std::size_t end = std::min(begin + kBundle, spans_.size());
    const Vec3 centre = (stations_[begin].p + stations_[end].p) / 2;
    double reach = 0;
    for (std::size_t i = begin; i <= end; ++i)
      reach = std::max(reach, (stations_[i].p - centre).norm() + stations_[i].radius);
    bundles_.push_back({centre, reach, begin, end});
  }
}

double TubeField::operator()(const Vec3& p) const {
  double best = std::numeric_limits<double>::infinity();
  for (const Bundle& bundle : bundles_) {
    const double enough = best + bundle.reach;
    if (enough <= 0 || (p - bundle.centre).squaredNorm() >= enough * enough) continue;
    for (std::size_t i = bundle.begin; i < bundle.end; ++i) {
      const Span& span = spans_[i];
      const Vec3 ap = p - span.from;
      const double t = std::clamp(ap.dot(span.along), 0.0, 1.0);
      best = std::min(best, (ap - t * span.whole).norm() - (span.radius + t * span.growth));
    }
  }
  return best;
}

double addTube(double f, const TubeField& tube, const Vec3& p, double grow, double k) {
  return tube.atLeast(p) - grow >= f + k ? f : smoothMin(f, tube(p) - grow, k);
}

double carveTube(double f, const TubeField& tube, const Vec3& p, double gap, double k) {
  return gap - tube.atLeast(p) <= f - k ? f : smoothMax(f, gap - tube(p), k);
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
