#include "anatomy/parametric/body_surface.h"

#include <algorithm>
#include <cmath>

#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/root.h"
#include "anatomy/shapes/spline.h"

namespace palpa::anatomy {
namespace {

constexpr double kFarFront = -150, kFarBack = 240;  // y that no body reaches
constexpr double kPlainSoft = 16;  // mm of skin, fat and muscle that chest() is written for

double hill(double x, double z, double x0, double z0, double wide, double high) {
  const double a = (x - x0) / wide, b = (z - z0) / high;
  return std::exp(-0.5 * (a * a + b * b));
}

double segmentDistance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm();
}

double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
  const Vec3 q = (p - centre).cwiseQuotient(radii);
  return (q.norm() - 1) * radii.minCoeff();
}

// Both sides look alike; smooth at the midline.
double mirrored(double l) { return std::sqrt(l * l + 16) - 4; }

// Soft tissue evens out the bone's quick changes of thickness.
TubeField draped(const std::vector<Section>& sections) {
  constexpr int kWindow = 9;
  const int count = static_cast<int>(sections.size());
  std::vector<TubeStation> stations;
  for (int i = 0; i < count; i += 2) {
    double sum = 0;
    for (int k = -kWindow; k <= kWindow; ++k) {
      const Section& s = sections[static_cast<std::size_t>(std::clamp(i + k, 0, count - 1))];
      sum += (s.half_up + s.half_side) / 2;
    }
    stations.push_back({sections[static_cast<std::size_t>(i)].centre, sum / (2 * kWindow + 1)});
  }
  return TubeField(std::move(stations));
}

// Held a little away from the body; cut 15 cm below the acromion.
struct Arm {
  Vec3 top, end;
};
Arm armAxis(const Vec3& acromion, const Build& build) {
  const Vec3 top = acromion + Vec3(4, 4, -36);
  return {top, top + 118 * build.tall * Vec3(0.36, 0.06, -0.93).normalized()};
}

TubeField armOf(const Vec3& acromion, const Build& build) {
  const double bulk = build.female ? 0 : 4, fat = 0.7 * build.softness;
  const auto [top, end] = armAxis(acromion, build);
  const Vec3 beyond = end + 60 * (end - top).normalized();
  return TubeField({{top, 31 + bulk + fat},
                    {(top + end) / 2, 34 + bulk + fat},
                    {end, 33 + bulk + fat},
                    {beyond, 31 + bulk + fat}});
}

TubeField scapulaOf(const Vec3& acromion, const Build& build) {
  return TubeField({{build.place({90, 152, -118}), 4},
                    {build.place({78, 137, -14}), 5},
                    {acromion + Vec3(-14, 34, -2), 7},
                    {acromion + Vec3(6, 8, -1), 8}});
}

}  // namespace

BodySurface::BodySurface(const Clavicle& clavicle, const Build& build, const SoftLayers& layers,
                         double at_window)
    : clavicle_(draped(clavicle.sections)),
      scapula_(scapulaOf(clavicle.acromial_end, build)),
      arm_(armOf(clavicle.acromial_end, build)),
      build_(build),
      skin_(1e3 * layers.skin),
      fat_(1e3 * layers.fat),
      muscle_(1e3 * layers.muscle),
      at_window_(at_window),
      window_a_(clavicle.middle.x()),
      acromion_(clavicle.acromial_end),
      lower_(build.lower()),
      upper_(build.upper()) {
  notch_ = living(Vec3::Zero());
}

// What the layers are at the entry, and from there to the window what the depth asked for there
// needs.
double BodySurface::soft(double a) const {
  const double entry = skin_ + fat_ + muscle_;
  const double from = 0.72 * window_a_;
  return entry + (at_window_ - entry) * std::clamp((a - from) / (window_a_ - from), 0.0, 1.0);
}

double BodySurface::muscle(double a) const {
  constexpr double kOver = 1.8, kThinnest = 0.6;  // mm
  return std::min(muscle_, std::max(soft(a) - kOver, kThinnest));
}

// The front of the trunk as a height y(l, z): smaller is further forward.
double BodySurface::chest(double l, double z) const {
  const Vec3 there = build_.unplace({l, 0, z});
  const double a = mirrored(there.x()), low = there.z();
  const double sagittal = 15 * std::tanh(low / 60) + 0.10 * low;
  const double across = a / 66;
  const double rounding =
      (1.2 + 2.2 * softStep(z + 25, 30) + 6 * softStep(z - 30, 20)) * across * across +
      1.0 * std::pow(across, 4);
  const double pectoral = -(build_.female ? 6 : 13) * hill(a, low, 76, -72, 40, 34);
  const double fold =
      build_.female ? 0 : 5 * hill(a, low, 72, -128, 44, 15);  // under the pectoral muscle
  const double sternal_groove = 3.5 * hill(a, 0, 0, 0, 15, 1) * softStep(-z - 22, 10);
  const double deltopectoral = 6 * hill(a, z, 116, -8, 15, 22);
  const double infraclavicular = (7.5 + 0.8 * std::max(0.0, kPlainSoft - skin_ - fat_ - muscle_)) *
                                 hill(a, z, 59, -9, 15, 14);  // deeper in the lean
  const double supraclavicular = 9 * hill(a, z, 66, 38, 24, 12);
  const double beside = 1 - hill(a, 0, 0, 0, 20, 1);
  const double belly = build_.softness * 0.8 * softStep(-low - 110, 40);
  return sagittal + rounding + pectoral + fold + sternal_groove + deltopectoral + infraclavicular +
         supraclavicular - (soft(std::abs(l)) - kPlainSoft) * beside - belly;
}

// Sides and back: an oval whose back follows the spine's curve, with a furrow over the spine.
double BodySurface::back(const Vec3& q) const {
  static const Spline wide{{-232, 138}, {-150, 139}, {-90, 141}, {-40, 145},
                           {10, 142},   {60, 120},   {90, 90}};
  static const Spline deep{{-232, 166}, {-170, 176}, {-110, 178}, {-50, 168},
                           {0, 150},    {50, 128},   {100, 116}};
  const double z = build_.unplace(q).z();
  const double fat = std::max(0.8 * build_.softness, -1.5);
  const double half = wide(z) * build_.wide + fat, middle = 66;
  const double furrow = 5 * hill(q.x(), 0, 0, 0, 11, 1) * softStep(-z + 20, 20);
  const double half_deep = deep(z) + fat - furrow - middle;
  const double u = std::abs(q.x()) / half,
               v = std::abs(q.y() - middle) / (q.y() > middle ? half_deep : 160.0);
  return 0.85 * (std::pow(std::pow(u, 2.7) + std::pow(v, 2.7), 1 / 2.7) - 1) * half_deep;
}

double BodySurface::neckAndJaw(const Vec3& q) const {
  const double thick = build_.female ? 0 : 3.5;
  const double fat = 0.45 * build_.softness;
  const double z = build_.unplace(q).z();
  const double centre = 66 - 0.10 * std::max(z, 0.0);
  const double round =
      std::hypot(q.x(), (q.y() - centre) * 0.95) - 54 - thick - fat + 0.05 * (84 - z);
  const double neck = smoothMax(round, z - 150, 30);
  // A mannequin's head: skull, jaw, chin, nose, brow, sockets, no more.
  const Vec3 p = build_.unplace(q);
  const double skull = ellipsoid(p, {0, 74, 236}, {73, 92, 84});
  const double face = ellipsoid(p, {0, 26, 190}, {57, 47, 70});
  const double chin = ellipsoid(p, {0, -6, 132}, {20, 15, 15});
  const double jaw = segmentDistance(p, {16, 2, 130}, {54, 58, 168}) - 12 - fat;
  const double cheek = ellipsoid(p, {38, 10, 196}, {21, 24, 20});
  const double nose = segmentDistance(p, {0, -16, 218}, {0, -31, 188}) - 8.5;
  const double lips = ellipsoid(p, {0, -15, 160}, {20, 9, 8});
  const double socket = 9 - (p - Vec3(31, -23, 218)).norm();
  const double larynx = ellipsoid(p, {0, 16.5, 70}, {9, 10, 16});
  double head = smoothMin(smoothMin(chin, jaw, 18), smoothMin(face, skull, 26), 16);
  head = smoothMax(smoothMin(smoothMin(head, cheek, 16), lips, 10), socket, 22);
  head = smoothMin(smoothMin(head, nose, 10), neck, 24);
  head = build_.female ? head : smoothMin(head, larynx, 12);
  const double sternomastoid = segmentDistance(q, {13, 11, 2}, build_.place({54, 62, 118})) - 9;
  return smoothMin(head, sternomastoid, 12);
}

double BodySurface::shoulder(const Vec3& q) const {
  const double bulk = build_.female ? 0 : 4;
  const double deltoid =
      ellipsoid(q, acromion_ + Vec3(9, 5, -44),
                Vec3(31 + bulk, 38 + bulk, 54) + Vec3::Constant(0.7 * build_.softness));
  const auto [top, end] = armAxis(acromion_, build_);
  return smoothMin(deltoid, smoothMax(arm_(q), (q - end).dot((end - top).normalized()), 9), 26);
}

double BodySurface::breast(const Vec3& q) const {
  // Lying on the back: flattened and a little to the side.
  const double full = std::sqrt(1 + std::max(build_.softness, -6.0) / 26);
  const Vec3 centre = build_.place({90, 0, -134});
  const double y = chest(centre.x(), centre.z()) + 9;
  return ellipsoid(q, {centre.x(), y, centre.z()}, {58 * full, 29 * full, 55 * full});
}

double BodySurface::bare(const Vec3& p) const {
  const Vec3 q(mirrored(p.x()), p.y(), p.z());
  // The height's slope makes it steeper than a distance; 0.8 brings both together.
  const double front = 0.8 * (chest(p.x(), p.z()) - p.y());
  // Trapezius: the shoulder's top falls from the neck to the acromion.
  const double acromion = acromion_.x(), top_there = acromion_.z() + 13;
  const double u = q.x() / acromion;
  const double top = 0.95 * (p.z() - (top_there + (76 - top_there) * (1 - u) * (1 - 0.45 * u)) -
                             (build_.female ? 0 : 5 * (1 - u)));
  double shape = smoothMax(smoothMax(front, top, 46), back(q), 30);
  shape = smoothMin(shape, neckAndJaw(q), 30);
  shape = smoothMin(shape, shoulder(q), 30);
  shape = addTube(shape, scapula_, q, skin_ + 0.6 * fat_, 26);
  const double gap = skin_ + fat_ - 3.2;  // over the clavicle the fat is thin
  shape = addTube(shape, clavicle_, q, std::min(gap, 5 + 0.15 * gap), 8);
  return shape - notch_ * std::exp(-0.5 * p.squaredNorm() / (11 * 11));
}

double BodySurface::living(const Vec3& p) const {
  const double f = bare(p);
  if (!build_.female) return f;
  return smoothMin(f, breast({mirrored(p.x()), p.y(), p.z()}), 34);
}

double BodySurface::cut(double f, const Vec3& p) const {
  for (const double plane : {lower_ - p.z(), p.z() - upper_}) f = smoothMax(f, plane, 9);
  return f;
}

double BodySurface::operator()(const Vec3& p) const { return cut(living(p), p); }

double BodySurface::front(double l, double z, bool under_breast) const {
  const auto field = [&](double y) { return under_breast ? bare({l, y, z}) : living({l, y, z}); };
  // From before the chest inward; no tangent of the field is steeper than the step allows.
  double outside = kFarFront;
  while (outside < kFarBack && field(outside + 5) > 0) outside += 5;
  return findRoot(field, outside, outside + 5, 1e-7);
}

Vec3 BodySurface::frontNormal(double l, double z) const {
  return gradient([this](const Vec3& p) { return bare(p); }, {l, front(l, z, true), z}, 2.0)
      .normalized();
}

TriangleMesh BodySurface::mesh() const {
  const double half = acromion_.x() + 110;
  const Eigen::AlignedBox3d box(Vec3(-half, kFarFront, lower_ - 10),
                                Vec3(half, kFarBack, upper_ + 10));
  const double size = 0.5 * build_.wide + 0.5 * build_.tall + 0.01 * std::max(build_.softness, 0.0);
  return surfaceNets(*this, box, (build_.bust() ? 3.4 : 4.35) * size, 2.5);
}

}  // namespace palpa::anatomy
