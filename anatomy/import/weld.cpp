#include "anatomy/import/weld.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "anatomy/import/surface_topology.h"

namespace palpa::anatomy {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Table of least areas: row i, column j stands for the part of the ring from i to j, closed by the
/// line j - i.
struct AreaTable {
  explicit AreaTable(std::size_t size) : n(size), area(size * size, 0), apex(size * size, 0) {}
  std::size_t at(std::size_t i, std::size_t j) const { return i * n + j; }
  std::size_t n;
  std::vector<double> area;
  std::vector<std::size_t> apex;
};

void fill(AreaTable* table, const std::vector<Vec3>& points, const std::vector<Corner>& ring,
          const std::function<bool(Corner, Corner)>& taken) {
  const auto place = [&](std::size_t i) { return points[ring[i]]; };
  for (std::size_t length = 2; length < table->n; ++length)
    for (std::size_t i = 0; i + length < table->n; ++i) {
      const std::size_t j = i + length;
      double& least = table->area[table->at(i, j)];
      least = kNever;
      const bool closing = length == table->n - 1;  // an edge of the ring itself
      if (!closing && taken(ring[i], ring[j])) continue;
      for (std::size_t k = i + 1; k < j; ++k) {
        const double area = table->area[table->at(i, k)] + table->area[table->at(k, j)] +
                            0.5 * (place(k) - place(i)).cross(place(j) - place(i)).norm();
        if (!(area < least)) continue;
        least = area;
        table->apex[table->at(i, j)] = k;
      }
    }
}

}  // namespace

std::vector<Triangle> closeRing(const std::vector<Vec3>& points, const std::vector<Corner>& ring,
                                const std::function<bool(Corner, Corner)>& taken) {
  std::vector<Triangle> triangles;
  if (ring.size() < 3) return triangles;
  AreaTable table(ring.size());
  fill(&table, points, ring, taken);
  if (table.area[table.at(0, table.n - 1)] == kNever) return triangles;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, table.n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::size_t k = table.apex[table.at(i, j)];
    triangles.push_back({ring[i], ring[k], ring[j]});
    open.push_back({i, k});
    open.push_back({k, j});
  }
  return triangles;
}

namespace {

constexpr double kFolded =
    0.94;  // cosine of 20 degrees between two triangles on one side of their edge
constexpr double kFinestGrid = 1e12;     // cells a side
constexpr std::size_t kMostInCell = 64;  // border points: more are no seam

/// One use of an edge: its ends and the third corner of the triangle.
struct TriangleEdge {
  Corner a, b, third;
};
using Pair = std::pair<Corner, Corner>;
Pair ordered(Corner a, Corner b) { return {std::min(a, b), std::max(a, b)}; }

class Welder {
 public:
  Welder(const RawMesh& mesh, double tolerance)
      : mesh_(mesh), tolerance_(tolerance), cluster_(mesh.points.size()) {
    std::iota(cluster_.begin(), cluster_.end(), 0u);
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        uses_[ordered(t[k], t[(k + 1) % 3])].push_back({t[k], t[(k + 1) % 3], t[(k + 2) % 3]});
    for (const auto& [edge, uses] : uses_)
      if (uses.size() == 1) border_.insert({edge.first, edge.second});
  }

  RawMesh run(WeldReport* report) {
    for (const auto& [squared, a, b] : nearPairs()) join(a, b);
    while (undoUseless()) {
    }
    return merged(report);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  using Near = std::tuple<double, Corner, Corner>;

  Cell cellOf(const Vec3& p) const {
    return {std::llround(p.x() / tolerance_), std::llround(p.y() / tolerance_),
            std::llround(p.z() / tolerance_)};
  }

  /// Pairs of border points within the tolerance, nearest first.
  std::vector<Near> nearPairs() const {
    std::vector<Near> pairs;
    std::map<Cell, std::vector<Corner>> cells;
    for (const Corner i : border_) {
      if (mesh_.points[i].cwiseAbs().maxCoeff() > kFinestGrid * tolerance_) return pairs;
      std::vector<Corner>& cell = cells[cellOf(mesh_.points[i])];
      if (cell.size() < kMostInCell) cell.push_back(i);
    }
    for (const auto& [cell, corners] : cells)
      for (int n = 0; n < 27; ++n) {
        const auto other =
            cells.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
        if (other == cells.end()) continue;
        for (const Corner a : corners)
          for (const Corner b : other->second) {
            const double squared = (mesh_.points[a] - mesh_.points[b]).squaredNorm();
            if (a < b && squared <= tolerance_ * tolerance_) pairs.emplace_back(squared, a, b);
          }
      }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  const std::vector<Corner>& membersOf(Corner root, std::vector<Corner>* single) const {
    const auto found = members_.find(root);
    if (found != members_.end()) return found->second;
    single->assign(1, root);
    return *single;
  }

  void join(Corner a, Corner b) {
    const Corner ra = cluster_[a], rb = cluster_[b];
    if (ra == rb) return;
    std::vector<Corner> single_a, single_b;
    const std::vector<Corner>&of_a = membersOf(ra, &single_a), &of_b = membersOf(rb, &single_b);
    for (const Corner i : of_a)
      for (const Corner j : of_b)
        if (uses_.count(ordered(i, j)) || (mesh_.points[i] - mesh_.points[j]).norm() > tolerance_)
          return;
    std::vector<Corner> all = of_a;
    all.insert(all.end(), of_b.begin(), of_b.end());
    for (const Corner i : all) cluster_[i] = ra;
    members_.erase(rb);
    members_[ra] = std::move(all);
  }

  Vec3 across(const TriangleEdge& use) const {
    const Vec3 along = (mesh_.points[use.b] - mesh_.points[use.a]).normalized();
    const Vec3 to = mesh_.points[use.third] - mesh_.points[use.a];
    return to - to.dot(along) * along;
  }

  bool folded(const TriangleEdge& one, const TriangleEdge& other) const {
    const Vec3 u = across(one), v = across(other);
    return u.dot(v) > kFolded * u.norm() * v.norm();
  }

  /// Dissolves clusters that close no edge, or that bring three triangles or two on each other to
  /// one edge.
  bool undoUseless() {
    std::map<Pair, std::vector<const TriangleEdge*>> at_edge;
    for (const auto& [edge, uses] : uses_) {
      const Corner a = cluster_[edge.first], b = cluster_[edge.second];
      if (!members_.count(a) && !members_.count(b)) continue;
      for (const TriangleEdge& use : uses) at_edge[ordered(a, b)].push_back(&use);
    }
    std::set<Corner> useful, harmful;
    for (const auto& [edge, uses] : at_edge) {
      if (uses.size() == 1) continue;
      const bool were_two =
          uses.size() == 2 && ordered(uses[0]->a, uses[0]->b) == ordered(uses[1]->a, uses[1]->b);
      if (were_two) continue;
      const bool closes = uses.size() == 2 && !folded(*uses[0], *uses[1]);
      (closes ? useful : harmful).insert({edge.first, edge.second});
    }
    std::vector<Corner> undone;
    for (const auto& [root, all] : members_)
      if (!useful.count(root) || harmful.count(root)) undone.push_back(root);
    for (const Corner root : undone) {
      for (const Corner i : members_[root]) cluster_[i] = i;
      members_.erase(root);
    }
    return !undone.empty();
  }

  RawMesh merged(WeldReport* report) const {
    RawMesh result;
    result.name = mesh_.name;
    std::vector<Vec3> places = mesh_.points;
    for (const auto& [root, all] : members_) {
      Vec3 mean = Vec3::Zero();
      for (const Corner i : all) mean += mesh_.points[i] / static_cast<double>(all.size());
      for (const Corner i : all)
        report->farthest = std::max(report->farthest, (mesh_.points[i] - mean).norm());
      places[root] = mean;
      report->joined_points += all.size() - 1;
    }
    std::vector<Corner> number(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (cluster_[i] != i) continue;
      number[i] = static_cast<Corner>(result.points.size());
      result.points.push_back(places[i]);
    }
    for (const Triangle& t : mesh_.triangles)
      result.triangles.push_back(
          {number[cluster_[t[0]]], number[cluster_[t[1]]], number[cluster_[t[2]]]});
    return result;
  }

  const RawMesh& mesh_;
  double tolerance_;
  std::map<Pair, std::vector<TriangleEdge>> uses_;
  std::set<Corner> border_;
  std::vector<Corner> cluster_;                    // of a point: a member of its cluster
  std::map<Corner, std::vector<Corner>> members_;  // of clusters of two and more
};

}  // namespace

RawMesh welded(const RawMesh& mesh, double tolerance, WeldReport* report) {
  *report = {};
  if (!(tolerance > 0)) return mesh;
  return Welder(mesh, tolerance).run(report);
}

}  // namespace palpa::anatomy
