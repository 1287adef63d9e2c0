#pragma once

#include <cmath>

#include "anatomy/import/mesh_file.h"

/// Round and flat surfaces made here, for what boxes do not show.
namespace palpa::anatomy::test {

/// A sphere of rings and spokes about the origin, closed, seen from outside counter-clockwise.
inline RawMesh ball(double radius, int rings, int spokes) {
  RawMesh mesh;
  mesh.points.push_back({0, 0, radius});
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < spokes; ++k) {
      const double a = M_PI * i / rings, b = 2 * M_PI * k / spokes;
      mesh.points.push_back(
          radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  mesh.points.push_back({0, 0, -radius});
  const auto at = [&](int i, int k) {
    return static_cast<std::uint32_t>(1 + (i - 1) * spokes + (k + spokes) % spokes);
  };
  const auto last = static_cast<std::uint32_t>(mesh.points.size() - 1);
  for (int k = 0; k < spokes; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
    mesh.triangles.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
  }
  return mesh;
}

/// A flat square of cells x cells quads, side 1, at height z from (x, 0); its normal +z or, turned,
/// -z.
inline RawMesh sheet(int cells, double x, double z, bool turned) {
  RawMesh mesh;
  for (int i = 0; i <= cells; ++i)
    for (int k = 0; k <= cells; ++k)
      mesh.points.push_back(
          {x + static_cast<double>(i) / cells, static_cast<double>(k) / cells, z});
  const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (cells + 1) + k); };
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  if (turned)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline void append(RawMesh* mesh, const RawMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh->points.size());
  mesh->points.insert(mesh->points.end(), other.points.begin(), other.points.end());
  for (const auto& t : other.triangles)
    mesh->triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace palpa::anatomy::test
