#include "anatomy/parametric/frame.h"

#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {

TriangleMesh fromB(const TriangleMesh& mesh_B_mm, Side side) {
  TriangleMesh mesh = mesh_B_mm;
  for (Vec3& p : mesh.points) p = fromB(p, side);
  if (side == Side::left) return mesh;
  for (Vec3& n : mesh.normals) n.x() = -n.x();
  flip(&mesh);
  return mesh;
}

}  // namespace palpa::anatomy
