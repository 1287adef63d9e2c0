#include "anatomy/parametric/body_surface.h"

#include <algorithm>
#include <cmath>

#include "anatomy/shapes/root.h"
#include "anatomy/shapes/surface_nets.h"

namespace palpa::anatomy {
namespace {

// Cuts of the bust: medial, lateral, lower, upper (neck), back.
constexpr double kMedial = -58, kLateral = 202, kLower = -140, kUpper = 84, kBack = 104;

double hill(double x, double z, double x0, double z0, double wide, double high) {
  const double a = (x - x0) / wide, b = (z - z0) / high;
  return std::exp(-0.5 * (a * a + b * b));
}

double segmentDistance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm();
}

// Both sides look alike; smooth at the midline.
double mirrored(double l) { return std::sqrt(l * l + 16) - 4; }

double softStep(double x, double width) { return 0.5 * (1 + std::tanh(x / width)); }

}  // namespace

namespace {

// Soft tissue evens out the bone's quick changes of thickness.
TubeField draped(const std::vector<Section>& sections) {
  constexpr int kWindow = 9;
  const int count = static_cast<int>(sections.size());
  std::vector<TubeField::Station> stations;
  for (int i = 0; i < count; i += 2) {
    double sum = 0;
    for (int k = -kWindow; k <= kWindow; ++k) {
      const Section& s = sections[std::clamp(i + k, 0, count - 1)];
      sum += (s.half_up + s.half_side) / 2;
    }
    stations.push_back({sections[i].centre, sum / (2 * kWindow + 1)});
  }
  return TubeField(std::move(stations));
}

}  // namespace

BodySurface::BodySurface(const Clavicle& clavicle, const SoftLayers& layers)
    : clavicle_(draped(clavicle.sections)),
      skin_(1e3 * layers.skin),
      fat_(1e3 * layers.fat),
      muscle_(1e3 * layers.muscle) {
  notch_ = living(Vec3::Zero());
}

// The front of the trunk as a height y(l, z): smaller is further forward.
double BodySurface::chest(double l, double z) const {
  const double a = mirrored(l);
  const double sagittal = 15 * std::tanh(z / 60) + 0.10 * z;
  const double across = a / 66;
  const double rounding =
      (1.2 + 2.2 * softStep(z + 25, 30) + 6 * softStep(z - 30, 20)) * across * across +
      1.0 * std::pow(across, 4);
  const double pectoral = -8 * hill(a, z, 78, -62, 42, 36);
  const double sternal_groove = 3.5 * hill(a, 0, 0, 0, 15, 1) * softStep(-z - 22, 10);
  const double deltopectoral = 6 * hill(a, z, 116, -8, 15, 22);
  const double infraclavicular = 7.5 * hill(a, z, 59, -9, 15, 14);
  const double supraclavicular = 9 * hill(a, z, 66, 38, 24, 12);
  const double soft = (skin_ + fat_ + muscle_ - 16) * (1 - hill(a, 0, 0, 0, 20, 1));
  return sagittal + rounding + pectoral + sternal_groove + deltopectoral + infraclavicular +
         supraclavicular - soft;
}

double BodySurface::living(const Vec3& p) const {
  const Vec3 q(mirrored(p.x()), p.y(), p.z());
  // The height's slope makes it steeper than a distance; 0.8 brings both together.
  const double front = 0.8 * (chest(p.x(), p.z()) - p.y());
  // Trapezius: the shoulder's top falls from the neck to the acromion.
  const double top = 0.95 * (p.z() - 74 + 0.20 * q.x() + 0.0005 * q.x() * q.x());
  const double trunk = smoothMax(front, top, 46);
  const double neck = std::hypot(q.x(), (q.y() - 72) * 0.95) - 57 + 0.06 * (84 - q.z());
  const double deltoid = (q - Vec3(160, 64, -26)).cwiseQuotient(Vec3(1, 1.05, 1.45)).norm() - 40;
  double shape = smoothMin(trunk, neck, 34);
  shape = smoothMin(shape, deltoid, 30);
  const double sternomastoid = segmentDistance(q, {13, 11, 2}, {50, 52, 92}) - 9;
  shape = smoothMin(shape, sternomastoid, 12);
  const double gap = skin_ + fat_ - 3.2;  // over the clavicle the fat is thin
  shape = smoothMin(shape, clavicle_(q) - gap, 9);
  return shape - notch_ * std::exp(-0.5 * p.squaredNorm() / (11 * 11));
}

double BodySurface::operator()(const Vec3& p) const {
  double f = living(p);
  f = smoothMax(f, p.x() - kLateral, 30);
  for (const double cut : {kMedial - p.x(), kLower - p.z(), p.z() - kUpper, p.y() - kBack})
    f = smoothMax(f, cut, 7);
  return f;
}

double BodySurface::front(double l, double z) const {
  // From before the chest inward; no tangent of the field is steeper than the step allows.
  double outside = -55;
  while (outside < kBack && (*this)({l, outside + 5, z}) > 0) outside += 5;
  return findRoot([&](double y) { return (*this)({l, y, z}); }, outside, outside + 5, 1e-7);
}

TriangleMesh BodySurface::mesh() const {
  const Eigen::AlignedBox3d box(Vec3(kMedial - 8, -60, kLower - 8),
                                Vec3(kLateral + 8, kBack + 8, kUpper + 8));
  return surfaceNets(*this, box, 3.2, 2.5);
}

}  // namespace palpa::anatomy
