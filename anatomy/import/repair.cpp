#include "anatomy/import/repair.h"

#include <map>
#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/import/surface_topology.h"
#include "anatomy/import/units_and_axes.h"
#include "anatomy/import/weld.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kLeastSolid = 4;  // triangles of the smallest solid

/// Every place once; triangles that are something, each once.
RawMesh joined(const RawMesh& mesh, RepairReport* report) {
  RawMesh result;
  result.name = mesh.name;
  std::size_t different = 0;
  const std::vector<Corner> number = numberedPlaces(mesh.points, &different);
  result.points.resize(different);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) result.points[number[i]] = mesh.points[i];
  report->joined_points = mesh.points.size() - different;
  std::set<Triangle> seen;
  for (const Triangle& t : mesh.triangles) {
    const Triangle n{number[t[0]], number[t[1]], number[t[2]]};
    const Triangle sorted = sortedCorners(n);
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2] || !seen.insert(sorted).second)
      ++report->dropped_triangles;
    else
      result.triangles.push_back(n);
  }
  return result;
}

/// Without scraps: parts that hang together by edges and have fewer than four triangles enclose
/// nothing. They stay where there is nothing else.
void dropScraps(RawMesh* mesh, RepairReport* report) {
  std::unordered_map<std::uint64_t, Corner> first_at;
  Pieces parts(mesh->triangles.size());
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& t = mesh->triangles[i];
      parts.join(
          first_at.emplace(edgeKey(t[k], t[(k + 1) % 3]), static_cast<Corner>(i)).first->second,
          static_cast<Corner>(i));
    }
  std::map<Corner, std::size_t> size;
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    ++size[parts.root(static_cast<Corner>(i))];
  std::vector<Triangle> kept;
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    if (size[parts.root(static_cast<Corner>(i))] >= kLeastSolid) kept.push_back(mesh->triangles[i]);
  if (kept.empty()) return;
  report->scraps += mesh->triangles.size() - kept.size();
  mesh->triangles = std::move(kept);
}

void turn(Triangle& t) { std::swap(t[1], t[2]); }

/// Whether the triangle goes along its edge from the smaller number to the larger.
bool forth(const Triangle& t, std::uint64_t key) {
  for (std::size_t k = 0; k < 3; ++k)
    if (edgeKey(t[k], t[(k + 1) % 3]) == key) return t[k] < t[(k + 1) % 3];
  return false;
}

/// Within each piece all triangles look to the side of its first one; across edges of two triangles
/// only.
void orient(RawMesh* mesh, std::vector<bool>* turned) {
  std::unordered_map<std::uint64_t, std::vector<Corner>> at_edge;
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      at_edge[edgeKey(mesh->triangles[i][k], mesh->triangles[i][(k + 1) % 3])].push_back(
          static_cast<Corner>(i));
  turned->assign(mesh->triangles.size(), false);
  std::vector<bool> done(mesh->triangles.size(), false);
  std::vector<Corner> open;
  for (std::size_t first = 0; first < mesh->triangles.size(); ++first) {
    if (done[first]) continue;
    done[first] = true;
    open.assign(1, static_cast<Corner>(first));
    while (!open.empty()) {
      const Triangle here = mesh->triangles[open.back()];
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t key = edgeKey(here[k], here[(k + 1) % 3]);
        const std::vector<Corner>& two = at_edge[key];
        if (two.size() != 2) continue;
        for (const Corner other : two) {
          if (done[other]) continue;
          done[other] = true;
          if (forth(mesh->triangles[other], key) == forth(here, key)) {
            turn(mesh->triangles[other]);
            (*turned)[other] = true;
          }
          open.push_back(other);
        }
      }
    }
  }
}

/// Rings of open edges, each from corner to corner as the missing triangles would go. Where rings
/// meet in a point they are parted there: a ring passes no point twice. `left`: edges that lie on
/// no ring.
std::vector<std::vector<Corner>> ringsOf(const RawMesh& mesh, std::size_t* left) {
  std::map<Corner, std::vector<Corner>> next;
  const Edges edges = edgesOf(mesh.triangles);
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner a = t[k], b = t[(k + 1) % 3];
      const EdgeUses& uses = edges.at(edgeKey(a, b));
      if (uses.forth + uses.back == 1)
        next[b].push_back(a);  // the missing triangle goes the other way
    }
  std::vector<std::vector<Corner>> rings;
  while (!next.empty()) {
    std::vector<Corner> way{next.begin()->first};
    std::map<Corner, std::size_t> on_way{{way[0], 0}};
    for (auto at = next.find(way.back()); at != next.end(); at = next.find(way.back())) {
      const Corner to = at->second.back();
      at->second.pop_back();
      if (at->second.empty()) next.erase(at);
      const auto met = on_way.find(to);
      if (met == on_way.end()) {
        on_way[to] = way.size();
        way.push_back(to);
        continue;
      }
      const auto begin = way.begin() + static_cast<std::ptrdiff_t>(met->second);
      rings.emplace_back(begin, way.end());
      for (auto i = begin + 1; i != way.end(); ++i) on_way.erase(*i);
      way.erase(begin + 1, way.end());
    }
    *left += way.size() - 1;
  }
  return rings;
}

/// By a fan about the ring's middle: where no triangles between its own points fit.
std::vector<Triangle> fanOver(const std::vector<Corner>& ring, std::vector<Vec3>* points) {
  Vec3 middle = Vec3::Zero();
  for (const Corner c : ring) middle += (*points)[c] / static_cast<double>(ring.size());
  const auto centre = static_cast<Corner>(points->size());
  points->push_back(middle);
  std::vector<Triangle> fan;
  for (std::size_t i = 0; i < ring.size(); ++i)
    fan.push_back({ring[i], ring[(i + 1) % ring.size()], centre});
  return fan;
}

void closeHoles(RawMesh* mesh, RepairReport* report) {
  std::set<Triangle> there;
  std::set<std::uint64_t> edges;
  for (const Triangle& t : mesh->triangles) {
    there.insert(sortedCorners(t));
    for (std::size_t k = 0; k < 3; ++k) edges.insert(edgeKey(t[k], t[(k + 1) % 3]));
  }
  const auto taken = [&](Corner a, Corner b) { return edges.count(edgeKey(a, b)) > 0; };
  for (const std::vector<Corner>& ring : ringsOf(*mesh, &report->left_holes)) {
    // The border of a single sheet of one triangle is no hole: what would close it is the sheet
    // itself.
    const bool itself = ring.size() == 3 && there.count(sortedCorners({ring[0], ring[1], ring[2]}));
    if (ring.size() < 3 || itself || ring.size() > kLargestHole) {
      ++report->left_holes;
      continue;
    }
    std::vector<Triangle> patch = closeRing(mesh->points, ring, taken);
    if (patch.empty()) patch = fanOver(ring, &mesh->points);
    for (const Triangle& t : patch) {
      mesh->triangles.push_back(t);
      there.insert(sortedCorners(t));
      for (std::size_t k = 0; k < 3; ++k) edges.insert(edgeKey(t[k], t[(k + 1) % 3]));
    }
    ++report->closed_holes;
    report->added_triangles += patch.size();
  }
}

/// Closed pieces of negative volume look outward afterwards.
void lookOutward(RawMesh* mesh, std::vector<bool>* turned) {
  Pieces pieces = piecesOf(mesh->triangles, mesh->points.size());
  std::map<Corner, std::vector<std::size_t>> of_piece;
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    of_piece[pieces.root(mesh->triangles[i][0])].push_back(i);
  for (const auto& [root, indices] : of_piece) {
    std::vector<Triangle> piece;
    for (const std::size_t i : indices) piece.push_back(mesh->triangles[i]);
    bool closed = true;
    for (const auto& [key, uses] : edgesOf(piece))
      closed = closed && uses.forth == 1 && uses.back == 1;
    if (!closed || enclosedVolume(mesh->points, piece, mesh->points[root]) >= 0) continue;
    for (const std::size_t i : indices) {
      turn(mesh->triangles[i]);
      if (i < turned->size()) (*turned)[i] = !(*turned)[i];
    }
  }
}

}  // namespace

RawMesh repaired(const RawMesh& mesh, RepairReport* report, double tolerance) {
  *report = {};
  RawMesh result = joined(mesh, report);
  WeldReport weld;
  RepairReport seams;  // triangles that a weld has made equal
  result = joined(welded(result, tolerance, &weld), &seams);
  report->welded_points = weld.joined_points;
  report->farthest_weld = weld.farthest;
  report->dropped_triangles += seams.dropped_triangles;
  dropScraps(&result, report);
  std::vector<bool> turned;
  orient(&result, &turned);
  closeHoles(&result, report);
  RepairReport again;  // a hole's middle may be a place that was there
  if (report->closed_holes > 0) result = joined(result, &again);
  if (again.changed()) orient(&result, &turned);
  lookOutward(&result, &turned);
  for (const bool was : turned) report->turned_triangles += was;
  return result;
}

std::vector<std::string> words(const RepairReport& report, double metres) {
  std::vector<std::string> all;
  const auto note = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0)
      all.push_back(count == 1 ? std::string(one) : std::to_string(count) + " " + many);
  };
  note(report.joined_points, "one repeated point joined", "repeated points joined");
  if (report.welded_points > 0)
    all.push_back(counted(report.welded_points, "point") +
                  " of seams joined, none moved by more than " +
                  lengthText(metres * report.farthest_weld));
  note(report.dropped_triangles, "one triangle dropped that was nothing or there twice",
       "triangles dropped that were nothing or there twice");
  note(report.scraps, "one loose triangle dropped", "loose triangles dropped");
  note(report.turned_triangles, "one triangle turned", "triangles turned");
  note(report.closed_holes, "one hole closed", "holes closed");
  note(report.left_holes, "one opening left", "openings left");
  return all;
}

}  // namespace palpa::anatomy
