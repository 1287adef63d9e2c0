#include "anatomy/parametric/frame.h"

#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {

TriangleMesh fromB(const TriangleMesh& mesh_B_mm, Side side) {
  TriangleMesh mesh = mesh_B_mm;
  for (Vec3& p : mesh.points) p = fromB(p, Side::left);
  return side == Side::left ? mesh : mirroredMesh(std::move(mesh));
}

}  // namespace palpa::anatomy
