#include "anatomy/shapes/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {
namespace {

constexpr int kCapRings = 6;

void addRing(const Section& s, int around, TriangleMesh* mesh) {
  const Vec3 side = s.tangent.cross(s.up);
  for (int k = 0; k < around; ++k) {
    const double angle = 2 * std::numbers::pi * k / around;
    mesh->points.push_back(s.centre + s.half_up * std::cos(angle) * s.up +
                           s.half_side * std::sin(angle) * side);
  }
}

// The section at angle `phi` of a half ellipsoid that closes an end; sign +1 at the last section.
Section capped(const Section& end, double phi, double bulge, double sign) {
  Section s = end;
  const double reach = bulge * (end.half_up + end.half_side) / 2;
  s.centre += sign * reach * std::sin(phi) * end.tangent;
  s.half_up *= std::cos(phi);
  s.half_side *= std::cos(phi);
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
