#include "anatomy/import/surface_topology.h"

#include <algorithm>
#include <cstring>

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

}  // namespace palpa::anatomy
