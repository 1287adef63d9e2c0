#include "anatomy/surface_patch_fit.h"

#include <Eigen/QR>
#include <cmath>
#include <numbers>

namespace palpa::anatomy {
namespace {

constexpr int kRings = 3, kPerRing = 6;  // ring r has 6 r points
constexpr int kSamples = 1 + kPerRing * kRings * (kRings + 1) / 2;
constexpr int kEnough = 20;
constexpr double kSameSide =
    0.3;  // cosine: a sample whose normal turns away more lies on another sheet

using Design = Eigen::Matrix<double, Eigen::Dynamic, SurfacePatch::kTerms, 0, kSamples>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kSamples>;
using Terms = Eigen::Matrix<double, SurfacePatch::kTerms, 1>;

Terms terms(double a, double b) {
  Terms t;
  t << 1, a, b, a * a, a * b, b * b, a * a * a, a * a * b, a * b * b, b * b * b;
  return t;
}

/// Rows for the samples that lie on this sheet of the surface; lengths in units of the reach.
class Samples {
 public:
  Samples(const Vec3& p, const Vec3& x, const Vec3& n, double reach)
      : p_(p),
        x_(x),
        y_(n.cross(x)),
        n_(n),
        reach_(reach),
        A_(kSamples, SurfacePatch::kTerms),
        h_(kSamples) {}

  void add(const SurfacePoint& s) {
    const Vec3 q = (s.p_A - p_) / reach_;
    const double a = q.dot(x_), b = q.dot(y_), out2 = a * a + b * b;
    if (s.n_A.dot(n_) < kSameSide || out2 > 1.2) return;
    const double weight = 1.3 - out2;
    A_.row(count_) = weight * terms(a, b).transpose();
    h_[count_++] = weight * q.dot(n_);
  }
  int count() const { return count_; }
  Terms solve() const { return A_.topRows(count_).colPivHouseholderQr().solve(h_.head(count_)); }

 private:
  Vec3 p_, x_, y_, n_;
  double reach_;
  Design A_;
  Column h_;
  int count_ = 0;
};

}  // namespace

SurfacePatch fitSurfacePatch(const SurfaceQuery& query, int surface, const Vec3& near_A,
                             double reach) {
  const SurfacePoint centre = query.rounded(surface, near_A);
  const Vec3 n = centre.n_A, x = rotationWithZ(n).col(0), y = n.cross(x);
  SurfacePatch patch;
  patch.p = pack(centre.p_A);
  patch.n = pack(n);
  patch.x = pack(x);
  patch.reach = reach;
  if (reach <= 0) return patch;
  Samples samples(centre.p_A, x, n, reach);
  samples.add(centre);
  for (int ring = 1; ring <= kRings; ++ring)
    for (int k = 0; k < kPerRing * ring; ++k) {
      const double turn = 2 * std::numbers::pi * (k + 0.5 * (ring % 2)) / (kPerRing * ring);
      const double out = reach * ring / kRings;
      samples.add(
          query.rounded(surface, centre.p_A + out * (std::cos(turn) * x + std::sin(turn) * y)));
    }
  if (samples.count() < kEnough) return patch;
  const Terms fitted = samples.solve();
  if (!fitted.allFinite()) return patch;
  static constexpr int kDegree[SurfacePatch::kTerms] = {0, 1, 1, 2, 2, 2, 3, 3, 3, 3};
  for (int i = 0; i < SurfacePatch::kTerms; ++i)
    patch.c[i] = fitted[i] * std::pow(reach, 1 - kDegree[i]);
  return patch;
}

}  // namespace palpa::anatomy
