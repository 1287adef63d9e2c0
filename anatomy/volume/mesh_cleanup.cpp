#include "anatomy/volume/mesh_cleanup.h"

#include <algorithm>
#include <numeric>
#include <tuple>

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

}  // namespace palpa::anatomy
