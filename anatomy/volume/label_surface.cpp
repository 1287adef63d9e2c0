#include "anatomy/volume/label_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {
namespace {

constexpr double kFold = -0.2;     // cosine between neighbours' normals
constexpr double kNoArea = 1e-11;  // m^2, twice a triangle's
constexpr int kRounds = 40, kWiden = 5;

/// An edge and the triangles on its two sides.
struct SharedEdge {
  std::uint32_t a, b, left, right;
};

std::vector<SharedEdge> sharedEdges(const TriangleMesh& mesh) {
  struct Use {
    std::uint32_t low, high, triangle;
  };
  std::vector<Use> uses;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      uses.push_back({low, high, t});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& x, const Use& y) {
    return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
  });
  std::vector<SharedEdge> edges;
  for (std::size_t i = 0; i + 1 < uses.size(); ++i)
    if (uses[i].low == uses[i + 1].low && uses[i].high == uses[i + 1].high)
      edges.push_back({uses[i].low, uses[i].high, uses[i].triangle, uses[i + 1].triangle});
  return edges;
}

class Unfolding {
 public:
  explicit Unfolding(TriangleMesh* mesh)
      : mesh_(*mesh),
        edges_(sharedEdges(*mesh)),
        marked_(mesh->points.size()),
        normals_(mesh->triangles.size()) {}

  int run() {
    int folded = mark();
    for (int round = 0; folded > 0 && round < kRounds; ++round) {
      for (int i = 0; i < round / kWiden; ++i) widen();
      relax();
      folded = mark();
    }
    return folded;
  }

 private:
  int mark() {
    std::fill(marked_.begin(), marked_.end(), 0);
    int folded = 0;
    for (std::size_t t = 0; t < normals_.size(); ++t) {
      const auto& c = mesh_.triangles[t];
      const Vec3 n =
          (mesh_.points[c[1]] - mesh_.points[c[0]]).cross(mesh_.points[c[2]] - mesh_.points[c[0]]);
      normals_[t] = n.normalized();
      if (n.norm() < kNoArea) markTriangle(t), ++folded;
    }
    for (const SharedEdge& edge : edges_)
      if (normals_[edge.left].dot(normals_[edge.right]) < kFold)
        markTriangle(edge.left), markTriangle(edge.right), ++folded;
    return folded;
  }

  void markTriangle(std::size_t t) {
    for (const std::uint32_t corner : mesh_.triangles[t]) marked_[corner] = 1;
  }

  void widen() {
    const std::vector<std::uint8_t> before = marked_;
    for (const SharedEdge& edge : edges_)
      if (before[edge.a] != before[edge.b]) marked_[edge.a] = marked_[edge.b] = 1;
  }

  void relax() {
    std::vector<Vec3> sum(mesh_.points.size(), Vec3::Zero());
    std::vector<int> count(mesh_.points.size(), 0);
    for (const SharedEdge& edge : edges_) {
      sum[edge.a] += mesh_.points[edge.b], ++count[edge.a];
      sum[edge.b] += mesh_.points[edge.a], ++count[edge.b];
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (marked_[i] && count[i]) mesh_.points[i] = sum[i] / count[i];
  }

  TriangleMesh& mesh_;
  std::vector<SharedEdge> edges_;
  std::vector<std::uint8_t> marked_;  ///< by vertex
  std::vector<Vec3> normals_;         ///< by triangle
};

std::uint32_t rootOf(std::vector<std::uint32_t>* parent, std::uint32_t i) {
  while ((*parent)[i] != i) i = (*parent)[i] = (*parent)[(*parent)[i]];
  return i;
}

}  // namespace

void keepLargestPiece(TriangleMesh* mesh) {
  std::vector<std::uint32_t> parent(mesh->points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const auto& t : mesh->triangles)
    for (const std::uint32_t corner : t) parent[rootOf(&parent, corner)] = rootOf(&parent, t[0]);
  std::vector<double> volume(parent.size(), 0);
  for (const auto& t : mesh->triangles)
    volume[rootOf(&parent, t[0])] +=
        mesh->points[t[0]].dot(mesh->points[t[1]].cross(mesh->points[t[2]]));
  if (volume.empty()) return;
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(volume.begin(), volume.end()) - volume.begin());
  std::vector<std::uint32_t> place(parent.size(), 0);
  TriangleMesh out;
  for (std::uint32_t i = 0; i < parent.size(); ++i)
    if (rootOf(&parent, i) == largest) {
      place[i] = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(mesh->points[i]);
      if (!mesh->normals.empty()) out.normals.push_back(mesh->normals[i]);
    }
  for (const auto& t : mesh->triangles)
    if (rootOf(&parent, t[0]) == largest)
      out.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  *mesh = std::move(out);
}

int unfold(TriangleMesh* mesh) { return Unfolding(mesh).run(); }

namespace {

constexpr double kClearance = 1.1e-3;  // a mesh strays from its field by up to 0.6 mm
constexpr int kAttempts = 4;
constexpr double kSmoother = 1.4;  // when a surface stays folded: more smoothing, so often
constexpr double kMargin = 12e-3;  // about the mask: the field is known so far

/// A box of the scan's voxels with values between them by three linear steps.
struct Patch {
  VoxelGrid grid;
  Index3 low{};
  Values values;

  double at(const Vec3& c) const {  // c: in voxels of the patch, inside it
    Index3 base{};
    Vec3 f;
    for (std::size_t a = 0; a < 3; ++a) {
      const double x = std::clamp(c[static_cast<int>(a)], 0.0, grid.size[a] - 1.0);
      base[a] = std::min(static_cast<int>(x), std::max(0, grid.size[a] - 2));
      f[static_cast<int>(a)] = x - base[a];
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      Index3 n{};
      for (std::size_t a = 0; a < 3; ++a) {
        const bool up = corner >> a & 1;
        n[a] = std::min(base[a] + up, grid.size[a] - 1);
        weight *= up ? f[static_cast<int>(a)] : 1 - f[static_cast<int>(a)];
      }
      if (weight > 0) sum += weight * values[grid.index(n)];
    }
    return sum;
  }
};

Patch patchAbout(const Scan& scan, const Mask& mask, double margin) {
  Index3 low = scan.grid.size, high{-1, -1, -1};
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (!mask[n]) continue;
    const Index3 c = scan.grid.cell(n);
    for (std::size_t a = 0; a < 3; ++a)
      low[a] = std::min(low[a], c[a]), high[a] = std::max(high[a], c[a]);
  }
  Patch patch;
  patch.grid.spacing = scan.grid.spacing;
  for (std::size_t a = 0; a < 3; ++a) {
    const int more = static_cast<int>(std::ceil(margin / scan.grid.spacing[static_cast<int>(a)]));
    patch.low[a] = std::max(0, low[a] - more);
    patch.grid.size[a] = std::min(scan.grid.size[a], high[a] + more + 1) - patch.low[a];
  }
  return patch;
}

Mask cut(const Scan& scan, const Patch& patch, const Mask& mask) {
  Mask out(patch.grid.count());
  for (std::size_t n = 0; n < out.size(); ++n) {
    const Index3 c = patch.grid.cell(n);
    out[n] = mask[scan.grid.index({c[0] + patch.low[0], c[1] + patch.low[1], c[2] + patch.low[2]})];
  }
  return out;
}

/// Calls visit(patch's voxel, scan's voxel).
template <class Visit>
void forPatch(const Scan& scan, const Patch& patch, Visit visit) {
  for (std::size_t n = 0; n < patch.values.size(); ++n) {
    const Index3 c = patch.grid.cell(n);
    visit(n, scan.grid.index({c[0] + patch.low[0], c[1] + patch.low[1], c[2] + patch.low[2]}));
  }
}

/// How far a place (in voxels of the scan) is outside of the outermost voxels' centres, metres.
double outsideOf(const VoxelGrid& grid, const Vec3& c) {
  double most = -1;
  for (int a = 0; a < 3; ++a)
    most = std::max(most, grid.spacing[a] *
                              std::max(-c[a], c[a] - (grid.size[static_cast<std::size_t>(a)] - 1)));
  return most;
}

/// One piece, facing outward; `*folded`: edges that stay folded.
TriangleMesh meshed(const Scan& scan, const Patch& patch, double cell, double outward,
                    double beyond, int* folded) {
  const Mat3 to_index = scan.volume.steps_S.inverse();
  const Vec3 low(patch.low[0], patch.low[1], patch.low[2]);
  const auto field = [&](const Vec3& p_S) {
    const Vec3 c = to_index * (p_S - scan.volume.origin_S);
    return std::max(patch.at(c - low) - outward, outsideOf(scan.grid, c) - beyond);
  };
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 c(corner & 1 ? patch.grid.size[0] : -1, corner & 2 ? patch.grid.size[1] : -1,
                 corner & 4 ? patch.grid.size[2] : -1);
    box.extend(scan.volume.pointToS(low + c));
  }
  const Vec3 more = Vec3::Constant(beyond + 3 * cell);
  TriangleMesh mesh = surfaceNets(field, {box.min() - more, box.max() + more}, cell);
  if (signedVolume(mesh) < 0) flip(&mesh);
  keepLargestPiece(&mesh);
  *folded = unfold(&mesh);
  computeNormals(&mesh);
  return mesh;
}

}  // namespace

Values nothingOccupied(const Scan& scan) { return Values(scan.grid.count(), 1.f); }

TriangleMesh labelSurface(const Scan& scan, const Mask& mask, Values* occupied, double smoothing,
                          double cell, double outward, double beyond) {
  if (std::find(mask.begin(), mask.end(), 1) == mask.end()) return {};
  Patch patch = patchAbout(scan, mask, kMargin + outward);
  const Values raw = signedDistance(patch.grid, largestPiece(patch.grid, cut(scan, patch, mask)));
  TriangleMesh mesh;
  int folded = 1;
  for (int attempt = 0; folded > 0 && attempt < kAttempts; ++attempt, smoothing *= kSmoother) {
    patch.values = blurred(patch.grid, raw, smoothing);
    if (occupied)
      forPatch(scan, patch, [&](std::size_t n, std::size_t there) {
        patch.values[n] =
            std::max(patch.values[n], static_cast<float>(kClearance) - (*occupied)[there]);
      });
    mesh = meshed(scan, patch, cell, outward, beyond, &folded);
  }
  if (occupied)
    forPatch(scan, patch, [&](std::size_t n, std::size_t there) {
      (*occupied)[there] = std::min((*occupied)[there], patch.values[n]);
    });
  return mesh;
}

}  // namespace palpa::anatomy
