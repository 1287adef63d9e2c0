#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "anatomy/skin_dimple.h"

class vtkPolyData;

namespace palpa::scene {

/// Moves the points and normals of a drawn skin in place, and puts them back bit for bit when the
/// push ends: what is not under a push has never been touched.
class DeflectedSkin {
 public:
  /// `drawn` shows `mesh` (polyDataOf) and has to outlive this.
  DeflectedSkin(const anatomy::TriangleMesh& mesh, vtkPolyData& drawn);

  void update(const std::optional<anatomy::SkinPush>& push);

 private:
  struct Before {
    std::uint32_t index;
    std::array<float, 3> p, n;
  };
  void restore();

  anatomy::SkinDimple dimple_;
  vtkPolyData& drawn_;
  float* points_;
  float* normals_;  // null: drawn without
  std::vector<Before> before_;
};

}  // namespace palpa::scene
