#include "anatomy/import/surface_check.h"

#include <set>

#include "anatomy/import/surface_topology.h"

namespace palpa::anatomy {
namespace {

void countEdges(const Edges& edges, std::size_t points, SurfaceCheck* check) {
  Pieces rings(points);
  std::set<Corner> on_rings;
  for (const auto& [pair, uses] : edges) {
    const int all = uses.forth + uses.back;
    check->crowded_edges += all > 2;
    check->turned_edges += all == 2 && uses.forth != 1;
    if (all != 1) continue;
    ++check->open_edges;
    const auto a = static_cast<Corner>(pair >> 32), b = static_cast<Corner>(pair & 0xffffffffu);
    rings.join(a, b);
    on_rings.insert({a, b});
  }
  std::set<Corner> roots;
  for (const Corner c : on_rings) roots.insert(rings.root(c));
  check->holes = roots.size();
}

std::size_t countPieces(const std::vector<Triangle>& triangles, std::size_t points) {
  Pieces pieces = piecesOf(triangles, points);
  std::set<Corner> roots;
  for (const Triangle& t : triangles) roots.insert(pieces.root(t[0]));
  return roots.size();
}

}  // namespace

SurfaceCheck checkSurface(const RawMesh& mesh) {
  SurfaceCheck check;
  std::size_t different = 0;
  const std::vector<Corner> number = numberedPlaces(mesh.points, &different);
  check.points = mesh.points.size();
  check.triangles = mesh.triangles.size();
  check.repeated_points = mesh.points.size() - different;
  std::set<Triangle> seen;
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles) {
    const Triangle n{number[t[0]], number[t[1]], number[t[2]]};
    const Triangle sorted = sortedCorners(n);
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2])
      ++check.degenerate;
    else if (!seen.insert(sorted).second)
      ++check.repeated_triangles;
    else
      kept.push_back(n);
  }
  countEdges(edgesOf(kept), different, &check);
  check.pieces = countPieces(kept, different);
  if (!mesh.triangles.empty()) check.low = check.high = mesh.points[mesh.triangles[0][0]];
  for (const Triangle& t : mesh.triangles)
    for (const Corner c : t) {
      check.low = check.low.cwiseMin(mesh.points[c]);
      check.high = check.high.cwiseMax(mesh.points[c]);
    }
  if (check.closed() && check.turned_edges == 0) {
    check.volume = enclosedVolume(mesh.points, mesh.triangles, (check.low + check.high) / 2);
    check.inside_out = check.volume < 0;
  }
  return check;
}

std::vector<std::string> findings(const SurfaceCheck& check) {
  std::vector<std::string> words;
  const auto tell = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0)
      words.push_back(count == 1 ? std::string(one) : std::to_string(count) + " " + many);
  };
  tell(check.holes, "one hole", "holes");
  tell(check.crowded_edges, "one edge with more than two triangles",
       "edges with more than two triangles");
  tell(check.turned_edges, "one edge whose triangles look to different sides",
       "edges whose triangles look to different sides");
  if (check.inside_out) words.push_back("inside out");
  tell(check.degenerate, "one triangle without an area", "triangles without an area");
  tell(check.repeated_triangles, "one triangle twice", "triangles twice");
  return words;
}

}  // namespace palpa::anatomy
