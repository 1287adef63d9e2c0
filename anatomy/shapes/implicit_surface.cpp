#include "anatomy/shapes/implicit_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::anatomy {

double smoothMin(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double smoothMax(double a, double b, double k) { return -smoothMin(-a, -b, k); }

TubeField::TubeField(std::vector<TubeStation> stations) : stations_(std::move(stations)) {
  constexpr std::size_t kBundle = 8;
  for (const TubeStation& s : stations_) {
    box_.extend(Vec3(s.p.array() - s.radius));
    box_.extend(Vec3(s.p.array() + s.radius));
  }
  for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
    const TubeStation &a = stations_[i], &b = stations_[i + 1];
    const Vec3 ab = b.p - a.p;
    spans_.push_back({a.p, ab / ab.squaredNorm(), ab, a.radius, b.radius - a.radius});
  }
  for (std::size_t begin = 0; begin < spans_.size(); begin += kBundle) {
    const std::size_t end = std::min(begin + kBundle, spans_.size());
    const Vec3 centre = (stations_[begin].p + stations_[end].p) / 2;
    double reach = 0;
    for (std::size_t i = begin; i <= end; ++i)
      reach = std::max(reach, (stations_[i].p - centre).norm() + stations_[i].radius);
    bundles_.push_back({centre, reach, begin, end});
  }
}

double TubeField::operator()(const Vec3& p) const {
  double best = std::numeric_limits<double>::infinity();
  for (const Bundle& bundle : bundles_) {
    const double enough = best + bundle.reach;
    if (enough <= 0 || (p - bundle.centre).squaredNorm() >= enough * enough) continue;
    for (std::size_t i = bundle.begin; i < bundle.end; ++i) {
      const TubeSpan& span = spans_[i];
      const Vec3 ap = p - span.from;
      const double t = std::clamp(ap.dot(span.along), 0.0, 1.0);
      best = std::min(best, (ap - t * span.whole).norm() - (span.radius + t * span.growth));
    }
  }
  return best;
}

double addTube(double f, const TubeField& tube, const Vec3& p, double grow, double k) {
  return tube.atLeast(p) - grow >= f + k ? f : smoothMin(f, tube(p) - grow, k);
}

double carveTube(double f, const TubeField& tube, const Vec3& p, double gap, double k) {
  return gap - tube.atLeast(p) <= f - k ? f : smoothMax(f, gap - tube(p), k);
}

Vec3 gradient(const Field& field, const Vec3& p, double step) {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 d = step * Vec3::Unit(axis);
    g[axis] = (field(p + d) - field(p - d)) / (2 * step);
  }
  return g;
}

namespace {

constexpr int kBlock = 4;
constexpr std::uint32_t kNone = ~0u;

class FieldGrid {
 public:
  FieldGrid(const Field& field, const Eigen::AlignedBox3d& box, double cell, double slope)
      : origin_(box.min()), cell_(cell) {
    for (int axis = 0; axis < 3; ++axis)
      size_[axis] = (static_cast<int>(std::ceil(box.sizes()[axis] / cell)) / kBlock + 1) * kBlock;
    values_.resize(std::size_t(size_[0]) * size_[1] * size_[2]);
    forBlocks([&](int x, int y, int z) { fillBlock(field, slope, x, y, z); });
    compose();
  }

  int size(int axis) const { return size_[axis]; }
  double value(int x, int y, int z) const { return values_[index(x, y, z)]; }
  std::size_t index(int x, int y, int z) const {
    return (std::size_t(z) * size_[1] + y) * size_[0] + x;
  }
  Vec3 point(double x, double y, double z) const { return origin_ + cell_ * Vec3(x, y, z); }

 private:
  template <typename Visit>
  void forBlocks(Visit visit) {
    for (int z = 0; z < size_[2]; z += kBlock)
      for (int y = 0; y < size_[1]; y += kBlock)
        for (int x = 0; x < size_[0]; x += kBlock) visit(x, y, z);
  }

  // One sample decides for blocks that the surface cannot reach.
  void fillBlock(const Field& field, double slope, int bx, int by, int bz) {
    constexpr double kHalf = (kBlock - 1) / 2.0;
    const double centre = field(point(bx + kHalf, by + kHalf, bz + kHalf));
    const double reach = slope * cell_ * std::sqrt(3.0) * (kHalf + 1);
    const bool far = std::abs(centre) > reach;
    for (int z = bz; z < bz + kBlock; ++z)
      for (int y = by; y < by + kBlock; ++y)
        for (int x = bx; x < bx + kBlock; ++x)
          values_[index(x, y, z)] = far ? centre : field(point(x, y, z));
  }

  // A cell that two sheets of the surface cut would join them in one vertex. That happens only
  // where equal signs meet across a diagonal of a face or of the cell (Latecki 1997): there the
  // outside sample nearest to the surface is taken inside. Samples only ever move inside, so this
  // ends; the surface moves by less than a cell.
  void compose() {
    for (bool changed = true; changed;) {
      changed = false;
      for (int z = 0; z + 1 < size_[2]; ++z)
        for (int y = 0; y + 1 < size_[1]; ++y)
          for (int x = 0; x + 1 < size_[0]; ++x) changed |= composeCell(x, y, z);
    }
  }

  bool composeCell(int x, int y, int z) {
    std::array<double*, 8> v;
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      v[corner] = &values_[index(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1))];
      inside += *v[corner] < 0;
    }
    if (inside < 2 || inside > 6) return false;
    bool changed = false;
    for (const int axis : {1, 2, 4})  // the two faces across each axis
      for (const int base : {0, axis}) {
        const int u = axis == 1 ? 2 : 1, w = axis == 4 ? 2 : 4;
        const bool a = *v[base] < 0, b = *v[base + u] < 0, c = *v[base + w] < 0,
                   d = *v[base + u + w] < 0;
        if (a != d || b != c || a == b) continue;
        a ? takeNearest({v[base + u], v[base + w]}) : takeNearest({v[base], v[base + u + w]});
        changed = true;
      }
    if (changed || (inside != 2 && inside != 6)) return changed;
    for (int corner = 0; corner < 4; ++corner) {
      const bool first = *v[corner] < 0;
      if (first != (*v[7 - corner] < 0) || first != (inside == 2)) continue;
      std::vector<double*> outside;
      for (double* sample : v)
        if (*sample >= 0) outside.push_back(sample);
      takeNearest(outside);
      return true;
    }
    return false;
  }

  void takeNearest(const std::vector<double*>& outside) {
    **std::min_element(outside.begin(), outside.end(),
                       [](const double* a, const double* b) { return *a < *b; }) = -1e-3 * cell_;
  }

  Vec3 origin_;
  double cell_;
  std::array<int, 3> size_;
  std::vector<double> values_;
};

// Mean of the crossings on the cell's twelve edges, in grid units; false where none is crossed.
bool cellVertex(const FieldGrid& grid, int x, int y, int z, Vec3* vertex) {
  Vec3 sum = Vec3::Zero();
  int crossings = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int cx = corner & 1, cy = corner >> 1 & 1, cz = corner >> 2 & 1;
    const double a = grid.value(x + cx, y + cy, z + cz);
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1) continue;
      const int dx = cx | (axis == 0), dy = cy | (axis == 1), dz = cz | (axis == 2);
      const double b = grid.value(x + dx, y + dy, z + dz);
      if ((a < 0) == (b < 0)) continue;
      sum += Vec3(x + cx, y + cy, z + cz) + a / (a - b) * Vec3::Unit(axis);
      ++crossings;
    }
  }
  if (crossings == 0) return false;
  *vertex = sum / crossings;
  return true;
}

std::vector<std::uint32_t> addVertices(const FieldGrid& grid, TriangleMesh* mesh) {
  std::vector<std::uint32_t> ids(std::size_t(grid.size(0)) * grid.size(1) * grid.size(2), kNone);
  for (int z = 0; z + 1 < grid.size(2); ++z)
    for (int y = 0; y + 1 < grid.size(1); ++y)
      for (int x = 0; x + 1 < grid.size(0); ++x) {
        Vec3 v;
        if (!cellVertex(grid, x, y, z, &v)) continue;
        ids[grid.index(x, y, z)] = static_cast<std::uint32_t>(mesh->points.size());
        mesh->points.push_back(grid.point(v.x(), v.y(), v.z()));
      }
  return ids;
}

void addQuad(std::array<std::uint32_t, 4> q, bool outward, TriangleMesh* mesh) {
  if (!outward) std::swap(q[1], q[3]);
  const auto& p = mesh->points;
  // The shorter diagonal gives the rounder triangles.
  if ((p[q[0]] - p[q[2]]).squaredNorm() > (p[q[1]] - p[q[3]]).squaredNorm())
    q = {q[1], q[2], q[3], q[0]};
  mesh->triangles.push_back({q[0], q[1], q[2]});
  mesh->triangles.push_back({q[0], q[2], q[3]});
}

void addQuads(const FieldGrid& grid, const std::vector<std::uint32_t>& ids, TriangleMesh* mesh) {
  const auto id = [&](int x, int y, int z) { return ids[grid.index(x, y, z)]; };
  for (int z = 1; z + 1 < grid.size(2); ++z)
    for (int y = 1; y + 1 < grid.size(1); ++y)
      for (int x = 1; x + 1 < grid.size(0); ++x) {
        const bool inside = grid.value(x, y, z) < 0;
        if (inside != (grid.value(x + 1, y, z) < 0))
          addQuad({id(x, y - 1, z - 1), id(x, y, z - 1), id(x, y, z), id(x, y - 1, z)}, inside,
                  mesh);
        if (inside != (grid.value(x, y + 1, z) < 0))
          addQuad({id(x - 1, y, z - 1), id(x - 1, y, z), id(x, y, z), id(x, y, z - 1)}, inside,
                  mesh);
        if (inside != (grid.value(x, y, z + 1) < 0))
          addQuad({id(x - 1, y - 1, z), id(x, y - 1, z), id(x, y, z), id(x - 1, y, z)}, inside,
                  mesh);
      }
}

void moveOntoSurface(const Field& field, double cell, TriangleMesh* mesh) {
  const double step = 0.05 * cell;
  mesh->normals.resize(mesh->points.size());
  for (std::size_t i = 0; i < mesh->points.size(); ++i) {
    Vec3& p = mesh->points[i];
    const Vec3 start = p;
    const Vec3 g = gradient(field, p, step);  // a cell is small: one slope serves all steps
    for (int iteration = 0; iteration < 5; ++iteration) {
      const double value = field(p);
      if (std::abs(value) < 1e-5 * cell) break;
      const Vec3 next = p - value * g / std::max(g.squaredNorm(), 0.05);
      if ((next - start).norm() > cell) break;  // at a crease: leave it where the cells put it
      p = next;
    }
    // Over a third of a cell: detail that the mesh cannot show must not glitter in its shading.
    mesh->normals[i] = gradient(field, p, cell / 3).normalized();
  }
}

}  // namespace

TriangleMesh surfaceNets(const Field& field, const Eigen::AlignedBox3d& box, double cell,
                         double slope) {
  TriangleMesh mesh;
  const FieldGrid grid(field, box, cell, slope);
  const std::vector<std::uint32_t> ids = addVertices(grid, &mesh);
  moveOntoSurface(field, cell, &mesh);
  addQuads(grid, ids, &mesh);
  return mesh;
}

}  // namespace palpa::anatomy
