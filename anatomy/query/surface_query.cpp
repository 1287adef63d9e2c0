#include "anatomy/query/surface_query.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/QR>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "anatomy/query/needle_passes.h"
#include "anatomy/query/primitive_fit.h"
#include "anatomy/query/triangle_tree.h"

namespace palpa::anatomy {
namespace {

constexpr int kCrossingsAtOnce = 128;  // with one surface

}  // namespace

struct SurfaceQuery::Impl {
  std::vector<TriangleTree> trees;
  std::vector<std::vector<ShapeOperator>> shapes;
  std::vector<Organ> organs;
};

SurfaceQuery::SurfaceQuery(const Patient& patient, Curvature curvature)
    : impl_(std::make_unique<Impl>()) {
  impl_->trees.reserve(patient.organs.size());
  for (const OrganSurface& surface : patient.organs) {
    if (surface.mesh.triangles.empty())
      throw Error("the surface \"" + surface.id + "\" has no triangles", "patient " + patient.name,
                  "Leave the surface out or give it a mesh");
    impl_->trees.emplace_back(surface.mesh);
    if (curvature == Curvature::ready) impl_->shapes.push_back(vertexShapeOperators(surface.mesh));
    impl_->organs.push_back(surface.organ);
  }
}

SurfaceQuery::~SurfaceQuery() = default;
SurfaceQuery::SurfaceQuery(SurfaceQuery&&) noexcept = default;
SurfaceQuery& SurfaceQuery::operator=(SurfaceQuery&&) noexcept = default;

int SurfaceQuery::surfaces() const { return static_cast<int>(impl_->trees.size()); }

SurfacePoint SurfaceQuery::closest(int surface, const Vec3& p_A) const {
  const TriangleTree::Closest nearest = impl_->trees.at(surface).closest(p_A);
  return {nearest.p, nearest.normal, nearest.signed_distance};
}

CurvedPoint SurfaceQuery::curved(int surface, const Vec3& p_A) const {
  if (impl_->shapes.empty())
    throw Error("the curvatures were left out", "surface query",
                "This is a fault of the program: report it");
  const TriangleTree::Closest nearest = impl_->trees.at(surface).closest(p_A);
  const std::vector<ShapeOperator>& shapes = impl_->shapes[surface];
  ShapeOperator S = ShapeOperator::Zero();
  for (int k = 0; k < 3; ++k) S += nearest.weights[k] * shapes[nearest.corners[k]];
  return {{nearest.p, nearest.normal, nearest.signed_distance},
          principalCurvatures(S, nearest.normal)};
}

SurfacePoint SurfaceQuery::rounded(int surface, const Vec3& p_A) const {
  const TriangleTree::Closest nearest = impl_->trees.at(surface).rounded(p_A);
  return {nearest.p, nearest.normal, nearest.signed_distance};
}

std::vector<RayHit> SurfaceQuery::cast(const Vec3& start_A, const Vec3& direction_A,
                                       double length) const {
  std::vector<RayHit> hits;
  std::vector<TriangleTree::Crossing> crossings(kCrossingsAtOnce);
  for (std::size_t i = 0; i < impl_->trees.size(); ++i) {
    bool lost = true;
    int count = 0;
    while (true) {
      count = impl_->trees[i].cast(start_A, direction_A, length, crossings.data(),
                                   static_cast<int>(crossings.size()), &lost);
      if (!lost) break;
      crossings.resize(2 * crossings.size());
    }
    for (int k = 0; k < count; ++k) {
      const auto& c = crossings[k];
      hits.push_back({c.s, c.normal, impl_->organs[i], static_cast<int>(i), c.entering});
    }
  }
  std::stable_sort(hits.begin(), hits.end(), [](const RayHit& a, const RayHit& b) {
    return a.s < b.s || (a.s == b.s && a.surface < b.surface);
  });
  return hits;
}

void SurfaceQuery::needle(const Vec3& start_A, const Vec3& tip_A, NeedlePasses* passes) const {
  const Vec3 way = tip_A - start_A;
  passes->count = 0;
  passes->lost = false;
  passes->length = way.norm();
  if (!(passes->length > 0)) return;
  std::array<TriangleTree::Crossing, kCrossingsAtOnce> crossings;
  for (int i = 0; i < surfaces(); ++i) {
    const TriangleTree& tree = impl_->trees[i];
    bool lost = false;
    const int count = tree.cast(start_A, way / passes->length, passes->length, crossings.data(),
                                kCrossingsAtOnce, &lost);
    passes->lost |= lost;
    if (count > 0) {
      addPasses({crossings.data(), static_cast<std::size_t>(count)}, impl_->organs[i], i, passes);
    } else if (tree.bounds().contains(tip_A) && inside(i, tip_A)) {
      addWhole(impl_->organs[i], i, passes);
    }
  }
}

SurfacePoint SurfaceQuery::nearSegment(int surface, const Vec3& a_A, const Vec3& b_A,
                                       double* s) const {
  const TriangleTree::SegmentDistance near = impl_->trees.at(surface).nearSegment(a_A, b_A);
  if (s) *s = near.s;
  return {near.p, near.normal, near.signed_distance};
}

int SurfaceQuery::nearMisses(const Vec3& tip_A, const Vec3& back_A,
                             std::span<NearMiss> misses) const {
  const int count = std::min(surfaces(), static_cast<int>(misses.size()));
  for (int i = 0; i < count; ++i) {
    const SurfacePoint tip = closest(i, tip_A);
    NearMiss& miss = misses[i];
    const SurfacePoint shaft = nearSegment(i, tip_A, back_A, &miss.shaft_s);
    miss.organ = impl_->organs[i];
    miss.surface = i;
    miss.tip = tip.distance;
    miss.shaft = shaft.distance;
    miss.tip_A = tip.p_A;
    miss.shaft_A = shaft.p_A;
  }
  return count;
}

SurfaceQuery::TangentPlane SurfaceQuery::tangentPlane(int surface, const Vec3& p_A,
                                                      double reach) const {
  const SurfacePoint near = closest(surface, p_A);
  const PlaneFit fit = fitPlaneTo(impl_->trees[surface], near.p_A, near.n_A, reach);
  return {near.p_A, fit.n, fit.rms};
}

bool SurfaceQuery::fitTube(int surface, const Vec3& p_A, double reach, Tube* tube) const {
  const TriangleTree& tree = impl_->trees.at(surface);
  if (tree.bounds().squaredExteriorDistance(p_A) > reach * reach) return false;
  const TubeFit fit = fitTubeTo(tree, p_A, reach);
  if (!fit.ok) return false;
  *tube = {fit.a, fit.b, fit.radius, fit.rms};
  return true;
}

namespace {

constexpr double kSpacing = 8e-3;  // of the first samples: bones bend on a larger scale
constexpr int kRefinements = 4;

}  // namespace

SurfacePoint nearestToSegment(const SurfaceQuery& query, int surface, const Vec3& a_A,
                              const Vec3& b_A) {
  const Vec3 way = b_A - a_A;
  const double length = way.norm();
  const int steps = static_cast<int>(std::ceil(length / kSpacing));
  SurfacePoint best = query.closest(surface, a_A);
  for (int i = 1; i <= steps; ++i) {
    const SurfacePoint at = query.closest(surface, a_A + way * i / steps);
    if (at.distance < best.distance) best = at;
  }
  for (int i = 0; i < kRefinements && length > 0; ++i) {
    const double t = std::clamp((best.p_A - a_A).dot(way) / (length * length), 0.0, 1.0);
    const SurfacePoint at = query.closest(surface, a_A + t * way);
    if (at.distance >= best.distance) break;
    best = at;
  }
  return best;
}

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
      samples.add(query.rounded(
          surface, centre.p_A + out * (pinned::cos(turn) * x + pinned::sin(turn) * y)));
    }
  if (samples.count() < kEnough) return patch;
  const Terms fitted = samples.solve();
  if (!fitted.allFinite()) return patch;
  static constexpr int kDegree[SurfacePatch::kTerms] = {0, 1, 1, 2, 2, 2, 3, 3, 3, 3};
  for (int i = 0; i < SurfacePatch::kTerms; ++i)
    patch.c[i] = fitted[i] * pinned::pow(reach, 1 - kDegree[i]);
  return patch;
}

}  // namespace palpa::anatomy
