#include "anatomy/shapes/mesh_tools.h"

#include <algorithm>

namespace palpa::anatomy {

void computeNormals(TriangleMesh* mesh) {
  mesh->normals.assign(mesh->points.size(), Vec3::Zero());
  for (const auto& t : mesh->triangles) {
    const Vec3& a = mesh->points[t[0]];
    const Vec3 n = (mesh->points[t[1]] - a).cross(mesh->points[t[2]] - a);
    for (const std::uint32_t corner : t) mesh->normals[corner] += n;
  }
  for (Vec3& n : mesh->normals) n.normalize();
}

void flip(TriangleMesh* mesh) {
  for (auto& t : mesh->triangles) std::swap(t[1], t[2]);
}

TriangleMesh mirroredMesh(TriangleMesh mesh) {
  for (Vec3& p : mesh.points) p.x() = -p.x();
  for (Vec3& n : mesh.normals) n.x() = -n.x();
  flip(&mesh);
  return mesh;
}

double signedVolume(const TriangleMesh& mesh) {
  double six = 0;
  for (const auto& t : mesh.triangles)
    six += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]]));
  return six / 6;
}

bool isClosed(const TriangleMesh& mesh) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> forward, backward;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      forward.emplace_back(t[k], t[(k + 1) % 3]);
      backward.emplace_back(t[(k + 1) % 3], t[k]);
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  const bool unique = std::adjacent_find(forward.begin(), forward.end()) == forward.end();
  return unique && forward == backward;
}

}  // namespace palpa::anatomy
