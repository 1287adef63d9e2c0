#pragma once

#include <memory>
#include <span>
#include <vector>

#include "anatomy/deflection/skin_deflection.h"
#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Where something presses the skin in, or draws it out. Frame A.
struct SkinPush {
  Vec3 p_A = Vec3::Zero();     ///< on the skin as it is when nothing touches it
  Vec3 n_A = Vec3::UnitZ();    ///< outward, unit
  double depth = 0;            ///< m: the skin is moved to p - depth n; negative: drawn out
  Vec3 lean_A = Vec3::Zero();  ///< see SkinDeflection; its part along n is ignored
};

/// The skin's mesh under a push: `SkinDeflection` in the tangent plane of the contact, moved along
/// its normal. A mesh is coarser than the contact, and its flat facet would pass above the tool's
/// tip; so all depths are scaled by one factor, such that the facet itself goes through p - depth
/// n. (Where no corner of the facet would move by a tenth of the depth, the mesh is too coarse, and
/// the factor is left at ten.) Vertices whose normals look away from n lie on another sheet and
/// stay.
class SkinDimple {
 public:
  explicit SkinDimple(const TriangleMesh& skin, const SkinDeflection::Settings& settings = {});
  ~SkinDimple();

  struct Vertex {
    std::uint32_t index;
    Vec3 p_A, n_A;  ///< where it is now
  };
  /// The vertices that are not where they were made; valid until the next call.
  std::span<const Vertex> press(const SkinPush& push);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::anatomy
