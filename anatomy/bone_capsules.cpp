#include "anatomy/bone_capsules.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpa::anatomy {
namespace {

constexpr int kMostRods = 48;
constexpr std::size_t kMostSamples = 800, kMostJudges = 800;
constexpr double kGoodRms = 0.0005, kWorstRms = 0.001;
constexpr double kReach = 0.026;  // rods further from the touched place are left out
constexpr double kGive =
    0.0003;  // by which the touching capsule may stick out beside the touched place
constexpr double kThickestTouch = 0.020;
constexpr double kHalfTouch = 0.008;  // half of the touching capsule's length, at most
constexpr double kBoneAxisReach = 0.012;
constexpr double kEndOfBone = 0.7;  // cosine: there the normal runs along the bone
constexpr double kHidden =
    0.0001;  // a rod that sticks so little out of the touching one says nothing new

/// The k-th of some vertices out of a long list, spread evenly over it whatever its order: by the
/// golden ratio.
std::size_t spread(std::size_t k, std::size_t all) {
  constexpr double kGolden = 0.6180339887498949;
  const double at = kGolden * static_cast<double>(k + 1);
  return std::min(static_cast<std::size_t>((at - std::floor(at)) * static_cast<double>(all)),
                  all - 1);
}

/// Every vertex of a small mesh; of a large one as many as will do.
std::vector<SurfaceSample> samplesOf(const TriangleMesh& mesh) {
  const std::size_t all = mesh.points.size(), count = std::min(all, kMostSamples);
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = count == all ? k : spread(k, all);
    samples.push_back({mesh.points[i], mesh.normals[i]});
  }
  return samples;
}

/// Of vertices beside the samples, from the union of the rods.
double misfitBeside(const TriangleMesh& mesh, std::size_t samples, const std::vector<Rod>& rods) {
  const std::size_t count = std::min(mesh.points.size() - samples, kMostJudges);
  double squares = 0;
  for (std::size_t k = 0; k < count; ++k) {
    double off = 1;
    for (const Rod& rod : rods)
      off = std::min(off, distanceTo(rod, mesh.points[spread(samples + k, mesh.points.size())]));
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

bool hides(const Rod& outer, const Rod& inner) {
  const double room = -inner.radius + kHidden;
  return distanceTo(outer, inner.a) <= room && distanceTo(outer, inner.b) <= room;
}

Capsule capsuleOf(const Rod& rod) {
  return {pack(rod.a), pack(rod.b), rod.radius, Organ::none, 0, {}};
}

}  // namespace

BoneCapsules::BoneCapsules(const TriangleMesh& mesh) : samples_(samplesOf(mesh)) {
  const RodFit fit = fitRods(samples_, kGoodRms, kMostRods);
  rods_ = fit.rods;
  rms_ =
      samples_.size() < mesh.points.size() ? misfitBeside(mesh, samples_.size(), rods_) : fit.rms;
}

Rod BoneCapsules::touching(const SurfacePoint& nearest) const {
  const Vec3 &p = nearest.p_A, &n = nearest.n_A, along = alongSurface(samples_, p, kBoneAxisReach);
  const bool end = std::abs(along.dot(n)) >= kEndOfBone;
  const Vec3 u = end ? Vec3(Vec3::Zero()) : Vec3((along - along.dot(n) * n).normalized());
  return inscribedRod(samples_, p, n, u, kGive, kThickestTouch, end ? 0 : kHalfTouch);
}

std::vector<Capsule> BoneCapsules::near(const SurfacePoint& nearest, int most) const {
  if (rods_.empty() || rms_ > kWorstRms || most < 1) return {};
  const Rod touch = touching(nearest);
  std::vector<Capsule> capsules{capsuleOf(touch)};
  if (most == 1) return capsules;

  std::vector<std::pair<double, Rod>> others;
  for (const Rod& rod : rods_) {
    Vec3 foot;
    const double d = distanceTo(rod, nearest.p_A, &foot);
    if (d > kReach) continue;
    const Vec3 back = std::min(d, 0.0) *
                      (nearest.p_A - foot).normalized();  // until it no longer covers the place
    const Rod moved{rod.a + back, rod.b + back, rod.radius};
    if (!hides(touch, moved)) others.emplace_back(d, moved);
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t count = std::min(others.size(), static_cast<std::size_t>(most - 1));
  for (std::size_t k = 0; k < count; ++k) capsules.push_back(capsuleOf(others[k].second));
  return capsules;
}

}  // namespace palpa::anatomy
