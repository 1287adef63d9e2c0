#include "anatomy/import/close_ring.h"

#include <limits>

namespace palpa::anatomy {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Table of least areas: row i, column j stands for the part of the ring from i to j, closed by the
/// line j - i.
struct Table {
  explicit Table(std::size_t size) : n(size), area(size * size, 0), apex(size * size, 0) {}
  std::size_t at(std::size_t i, std::size_t j) const { return i * n + j; }
  std::size_t n;
  std::vector<double> area;
  std::vector<std::size_t> apex;
};

void fill(Table* table, const std::vector<Vec3>& points, const std::vector<Corner>& ring,
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
  Table table(ring.size());
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

}  // namespace palpa::anatomy
