#include "anatomy/shapes/sheet.h"

#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {

TriangleMesh sheet(const std::function<SheetPoint(double u, double v)>& at, int along, int across) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> front, back;
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= along; ++i) {
      const SheetPoint s = at(double(i) / along, double(j) / across);
      front.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.push_back(s.middle + s.front * s.normal);
      const bool border = i == 0 || j == 0 || i == along || j == across;
      back.push_back(border ? front.back() : static_cast<std::uint32_t>(mesh.points.size()));
      if (!border) mesh.points.push_back(s.middle - s.back * s.normal);
    }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < along; ++i) {
      const std::size_t a = std::size_t(j) * (along + 1) + i, b = a + 1, c = b + along + 1,
                        d = c - 1;
      // At two corners the diagonal turns, lest front and back share a whole triangle.
      const bool corner = (i == along - 1 && j == 0) || (i == 0 && j == across - 1);
      if (corner) {
        quad(front[b], front[c], front[d], front[a]);
        quad(back[b], back[a], back[d], back[c]);
      } else {
        quad(front[a], front[b], front[c], front[d]);
        quad(back[a], back[d], back[c], back[b]);
      }
    }
  if (signedVolume(mesh) < 0) flip(&mesh);
  computeNormals(&mesh);
  return mesh;
}

}  // namespace palpa::anatomy
