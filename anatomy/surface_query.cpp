#include "anatomy/surface_query.h"

#include <algorithm>

#include "anatomy/geometry/error.h"
#include "anatomy/triangle_tree.h"
#include "anatomy/tube_fit.h"

namespace palpa::anatomy {

struct SurfaceQuery::Impl {
  std::vector<TriangleTree> trees;
  std::vector<Organ> organs;
};

SurfaceQuery::SurfaceQuery(const Patient& patient) : impl_(std::make_unique<Impl>()) {
  impl_->trees.reserve(patient.organs.size());
  for (const OrganSurface& surface : patient.organs) {
    if (surface.mesh.triangles.empty())
      throw Error("the surface \"" + surface.id + "\" has no triangles", "patient " + patient.name,
                  "Leave the surface out or give it a mesh");
    impl_->trees.emplace_back(surface.mesh);
    impl_->organs.push_back(surface.organ);
  }
}

SurfaceQuery::~SurfaceQuery() = default;
SurfaceQuery::SurfaceQuery(SurfaceQuery&&) noexcept = default;
SurfaceQuery& SurfaceQuery::operator=(SurfaceQuery&&) noexcept = default;

SurfacePoint SurfaceQuery::closest(int surface, const Vec3& p_A) const {
  const TriangleTree::Closest nearest = impl_->trees.at(surface).closest(p_A);
  return {nearest.p, nearest.normal, nearest.signed_distance};
}

SurfacePoint SurfaceQuery::rounded(int surface, const Vec3& p_A) const {
  const TriangleTree::Closest nearest = impl_->trees.at(surface).rounded(p_A);
  return {nearest.p, nearest.normal, nearest.signed_distance};
}

std::vector<RayHit> SurfaceQuery::cast(const Vec3& start_A, const Vec3& direction_A,
                                       double length) const {
  std::vector<RayHit> hits;
  std::vector<TriangleTree::Crossing> crossings;
  for (std::size_t i = 0; i < impl_->trees.size(); ++i) {
    crossings.clear();
    impl_->trees[i].cast(start_A, direction_A, length, &crossings);
    for (const auto& c : crossings)
      hits.push_back({c.s, c.normal, impl_->organs[i], static_cast<int>(i), c.entering});
  }
  std::stable_sort(hits.begin(), hits.end(), [](const RayHit& a, const RayHit& b) {
    return a.s < b.s || (a.s == b.s && a.surface < b.surface);
  });
  return hits;
}

bool SurfaceQuery::fitTube(int surface, const Vec3& p_A, double reach, Tube* tube) const {
  const TriangleTree& tree = impl_->trees.at(surface);
  if (tree.bounds().squaredExteriorDistance(p_A) > reach * reach) return false;
  const TubeFit fit = fitTubeTo(tree.points(), tree.normals(), p_A, reach);
  if (!fit.ok) return false;
  *tube = {fit.a, fit.b, fit.radius, fit.rms};
  return true;
}

}  // namespace palpa::anatomy
