#include "anatomy/import/surface_topology.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace palpa::anatomy {
namespace {

struct PlaceHash {
  std::size_t operator()(const Packed3& p) const {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const double x : p) {
      std::uint64_t bits = 0;
      const double plain = x == 0 ? 0 : x;  // one zero
      std::memcpy(&bits, &plain, sizeof bits);
      h = (h ^ bits) * 0x100000001b3u;
      h ^= h >> 29;
    }
    return h;
  }
};

}  // namespace

std::vector<Corner> numberedPlaces(const std::vector<Vec3>& points, std::size_t* different) {
  std::unordered_map<Packed3, Corner, PlaceHash> numbers;
  numbers.reserve(points.size());
  std::vector<Corner> of;
  of.reserve(points.size());
  for (const Vec3& p : points)
    of.push_back(numbers.emplace(pack(p), static_cast<Corner>(numbers.size())).first->second);
  *different = numbers.size();
  return of;
}

Triangle sortedCorners(const Triangle& triangle) {
  Triangle sorted = triangle;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::uint64_t edgeKey(Corner a, Corner b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

Edges edgesOf(const std::vector<Triangle>& triangles) {
  Edges edges;
  edges.reserve(2 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner a = t[k], b = t[(k + 1) % 3];
      EdgeUses& uses = edges[edgeKey(a, b)];
      ++(a < b ? uses.forth : uses.back);
    }
  return edges;
}

double enclosedVolume(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                      const Vec3& middle) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = points[t[0]] - middle, b = points[t[1]] - middle, c = points[t[2]] - middle;
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

Pieces piecesOf(const std::vector<Triangle>& triangles, std::size_t points) {
  Pieces pieces(points);
  for (const Triangle& t : triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[1], t[2]);
  }
  return pieces;
}

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
  const auto note = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0)
      words.push_back(count == 1 ? std::string(one) : std::to_string(count) + " " + many);
  };
  note(check.holes, "one hole", "holes");
  note(check.crowded_edges, "one edge with more than two triangles",
       "edges with more than two triangles");
  note(check.turned_edges, "one edge whose triangles look to different sides",
       "edges whose triangles look to different sides");
  if (check.inside_out) words.push_back("inside out");
  note(check.degenerate, "one triangle without an area", "triangles without an area");
  note(check.repeated_triangles, "one triangle twice", "triangles twice");
  return words;
}

}  // namespace palpa::anatomy
