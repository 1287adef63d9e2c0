#include "anatomy/query/section.h"

#include <map>
#include <set>
#include <utility>

namespace palpa::anatomy {
namespace {

/// Of a mesh, by its corners: the smaller number first.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edgeOf(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Each corner's number, the same for corners at the same place: a texture's seam parts none.
std::vector<std::uint32_t> joined(const std::vector<Vec3>& points) {
  std::map<Packed3, std::uint32_t> first;
  std::vector<std::uint32_t> number(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    number[i] = first.emplace(pack(points[i]), i).first->second;
  return number;
}

/// From the edge by which a triangle's outline goes down through the plane to that by which it
/// comes up: its neighbour beyond the second goes down there, so that pieces follow one another.
std::map<Edge, Edge> pieces(const TriangleMesh& mesh, const std::vector<double>& offset) {
  const std::vector<std::uint32_t> number = joined(mesh.points);
  std::map<Edge, Edge> next;
  for (const auto& corners : mesh.triangles) {
    Edge up{}, down{};
    bool cut = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = number[corners[i]], b = number[corners[(i + 1) % 3]];
      if ((offset[a] < 0) == (offset[b] < 0)) continue;
      (offset[a] < 0 ? up : down) = edgeOf(a, b);
      cut = true;
    }
    if (cut && down != up) next.emplace(down, up);  // a sliver joins an edge to itself
  }
  return next;
}

}  // namespace

std::vector<SectionLine> sectionOf(const OrganSurface& organ, const SectionPlane& plane) {
  const std::vector<Vec3>& points = organ.mesh.points;
  std::vector<double> offset;
  offset.reserve(points.size());
  for (const Vec3& p : points) offset.push_back(plane.offset(p));
  std::map<Edge, Edge> next = pieces(organ.mesh, offset);

  const auto crossing = [&](const Edge& edge) {
    const double a = offset[edge.first], b = offset[edge.second];
    return plane.at(points[edge.first] + a / (a - b) * (points[edge.second] - points[edge.first]));
  };
  const auto lineFrom = [&](const Edge& start) {
    SectionLine line{organ.organ, false, {}};
    Edge edge = start;
    for (auto piece = next.find(edge); piece != next.end(); piece = next.find(edge)) {
      line.points.push_back(crossing(edge));
      edge = piece->second;
      next.erase(piece);
    }
    line.closed = edge == start;
    if (!line.closed) line.points.push_back(crossing(edge));
    return line;
  };

  std::vector<SectionLine> lines;
  std::set<Edge> led_to;  // an edge that no piece leads to begins an open line
  for (const auto& [from, to] : next) led_to.insert(to);
  std::vector<Edge> open;
  for (const auto& [from, to] : next)
    if (!led_to.contains(from)) open.push_back(from);
  for (const Edge& edge : open) lines.push_back(lineFrom(edge));
  while (!next.empty()) lines.push_back(lineFrom(Edge(next.begin()->first)));
  return lines;
}

}  // namespace palpa::anatomy
