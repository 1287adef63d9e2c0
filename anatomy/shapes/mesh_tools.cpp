#include "anatomy/shapes/mesh_tools.h"

#include <algorithm>
#include <numbers>

#include "anatomy/base/pinned_math.h"

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
      // At two corners the diagonal turns, so that front and back share no whole triangle.
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

namespace {

constexpr int kCapRings = 6;

void addRing(const Section& s, int around, TriangleMesh* mesh) {
  const Vec3 side = s.tangent.cross(s.up);
  for (int k = 0; k < around; ++k) {
    const double angle = 2 * std::numbers::pi * k / around;
    mesh->points.push_back(s.centre + s.half_up * pinned::cos(angle) * s.up +
                           s.half_side * pinned::sin(angle) * side);
  }
}

// The section at angle `phi` of a half ellipsoid that closes an end; sign +1 at the last section.
Section capped(const Section& end, double phi, double bulge, double sign) {
  Section s = end;
  const double reach = bulge * (end.half_up + end.half_side) / 2;
  s.centre += sign * reach * pinned::sin(phi) * end.tangent;
  s.half_up *= pinned::cos(phi);
  s.half_side *= pinned::cos(phi);
  return s;
}

std::vector<Section> withCaps(const std::vector<Section>& sections, double bulge) {
  std::vector<Section> all;
  const double step = std::numbers::pi / 2 / (kCapRings + 1);
  for (int i = kCapRings; i > 0; --i) all.push_back(capped(sections.front(), i * step, bulge, -1));
  all.insert(all.end(), sections.begin(), sections.end());
  for (int i = 1; i <= kCapRings; ++i) all.push_back(capped(sections.back(), i * step, bulge, 1));
  return all;
}

}  // namespace

std::vector<Section> sectionsAlong(const std::vector<Vec3>& centres, const Vec3& up) {
  std::vector<Section> sections;
  const std::size_t n = centres.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& before = centres[i > 0 ? i - 1 : 0];
    const Vec3& after = centres[std::min(i + 1, n - 1)];
    const Vec3 tangent = (after - before).normalized();
    sections.push_back({centres[i], tangent, (up - tangent * tangent.dot(up)).normalized(), 1, 1});
  }
  return sections;
}

TriangleMesh sweep(const std::vector<Section>& sections, int around, double bulge) {
  TriangleMesh mesh;
  const std::vector<Section> rings = withCaps(sections, bulge);
  for (const Section& ring : rings) addRing(ring, around, &mesh);
  const auto first_pole = static_cast<std::uint32_t>(mesh.points.size());
  constexpr double kQuarter = std::numbers::pi / 2;
  mesh.points.push_back(capped(sections.front(), kQuarter, bulge, -1).centre);
  mesh.points.push_back(capped(sections.back(), kQuarter, bulge, 1).centre);

  const auto vertex = [&](std::size_t ring, int k) {
    return static_cast<std::uint32_t>(ring * around + k % around);
  };
  const std::size_t last = rings.size() - 1;
  for (int k = 0; k < around; ++k) {
    mesh.triangles.push_back({first_pole, vertex(0, k + 1), vertex(0, k)});
    mesh.triangles.push_back({first_pole + 1, vertex(last, k), vertex(last, k + 1)});
    for (std::size_t r = 0; r < last; ++r) {
      mesh.triangles.push_back({vertex(r, k), vertex(r, k + 1), vertex(r + 1, k + 1)});
      mesh.triangles.push_back({vertex(r, k), vertex(r + 1, k + 1), vertex(r + 1, k)});
    }
  }
  if (signedVolume(mesh) < 0) flip(&mesh);
  computeNormals(&mesh);
  return mesh;
}

}  // namespace palpa::anatomy
