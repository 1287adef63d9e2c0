#include "anatomy/query/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace palpa::anatomy {
namespace {

struct Parameters {
  double s, t;
};

/// Nearest points of a + s u and c + t v, 0 <= s, t <= 1 (Ericson 5.1.9).
Parameters nearestOfSegments(const Vec3& a, const Vec3& u, const Vec3& c, const Vec3& v) {
  const Vec3 r = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), vr = v.dot(r), ur = u.dot(r),
               uv = u.dot(v);
  if (!(uu > 0)) return {0, vv > 0 ? std::clamp(vr / vv, 0.0, 1.0) : 0};
  if (!(vv > 0)) return {std::clamp(-ur / uu, 0.0, 1.0), 0};
  const double across = uu * vv - uv * uv;
  double s = across > 0 ? std::clamp((uv * vr - ur * vv) / across, 0.0, 1.0) : 0;
  double t = (uv * s + vr) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((uv * t - ur) / uu, 0.0, 1.0);
  }
  return {s, t};
}

/// True, and where, if the segment runs through the triangle's inside.
bool meets(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t, SegmentToTriangle* found) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double at_a = n.dot(a - t[0]), at_b = n.dot(b - t[0]);
  if (at_a * at_b > 0 || at_a == at_b) return false;
  const double s = at_a / (at_a - at_b);
  const Vec3 p = a + s * (b - a);
  Vec3 w(n.dot((t[2] - t[1]).cross(p - t[1])), n.dot((t[0] - t[2]).cross(p - t[2])),
         n.dot((t[1] - t[0]).cross(p - t[0])));
  if (w.minCoeff() < 0 || !(w.sum() > 0)) return false;
  *found = {0, s, w / w.sum()};
  return true;
}

}  // namespace

SegmentToTriangle segmentToTriangle(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t) {
  SegmentToTriangle best{};
  if (meets(a, b, t, &best)) return best;
  const Vec3 way = b - a;
  best.weights = closestWeights(a, t[0], t[1], t[2]);
  const auto at = [&](const Vec3& w) { return Vec3(w[0] * t[0] + w[1] * t[1] + w[2] * t[2]); };
  best.squared = (at(best.weights) - a).squaredNorm();
  const Vec3 from_b = closestWeights(b, t[0], t[1], t[2]);
  if (const double squared = (at(from_b) - b).squaredNorm(); squared < best.squared)
    best = {squared, 1, from_b};
  for (int k = 0; k < 3; ++k) {
    const Vec3 &c = t[k], &d = t[(k + 1) % 3];
    const Parameters near = nearestOfSegments(a, way, c, d - c);
    const double squared = (a + near.s * way - c - near.t * (d - c)).squaredNorm();
    if (squared >= best.squared) continue;
    best = {squared, near.s, Vec3::Zero()};
    best.weights[k] = 1 - near.t;
    best.weights[(k + 1) % 3] = near.t;
  }
  return best;
}

Vec3 closestWeights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace palpa::anatomy
