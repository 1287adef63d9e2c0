#include "anatomy/phantom_block.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "anatomy/geometry/error.h"

namespace palpa::anatomy {
namespace {

constexpr double kShortestSide = 0.010, kLongestSide = 2;  // m
constexpr double kBlockStep = 0.0025;                      // m: fine enough to give way under a tip
constexpr int kMostSteps = 120, kArcSteps = 3;  // along a side; along an eighth of a circle
constexpr std::array<float, 4> kBlockColour{0.93F, 0.79F, 0.71F, 1};

using Lattice = std::array<std::uint32_t, 3>;

/// Where lattice planes cut an axis, from -half to half: even along the flat part, and by even
/// angles where edges are round.
std::vector<double> cutsAlong(double side) {
  const double flat = side / 2 - kBlockEdge;
  const int steps = std::clamp(static_cast<int>(std::lround(2 * flat / kBlockStep)), 1, kMostSteps);
  std::vector<double> cuts;
  for (int i = kArcSteps; i > 0; --i)
    cuts.push_back(-flat - kBlockEdge * std::tan(std::numbers::pi / 4 * i / kArcSteps));
  for (int i = 0; i <= steps; ++i) cuts.push_back(flat * (2.0 * i / steps - 1));
  for (int i = 1; i <= kArcSteps; ++i)
    cuts.push_back(flat + kBlockEdge * std::tan(std::numbers::pi / 4 * i / kArcSteps));
  return cuts;
}

/// The surface of a box's lattice, pushed onto the box with round edges: every point shared, so the
/// mesh is closed.
class BlockMesh {
 public:
  explicit BlockMesh(const Vec3& size) : flat_(size / 2 - Vec3::Constant(kBlockEdge)) {
    for (int axis = 0; axis < 3; ++axis)
      cuts_[static_cast<std::size_t>(axis)] = cutsAlong(size[axis]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      addFace(axis, false);
      addFace(axis, true);
    }
  }
  TriangleMesh mesh;

 private:
  std::uint32_t last(std::size_t axis) const {
    return static_cast<std::uint32_t>(cuts_[axis].size()) - 1;
  }

  std::uint32_t pointAt(const Lattice& at) {
    const auto [entry, is_new] =
        index_.try_emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
    if (!is_new) return entry->second;
    const Vec3 q(cuts_[0][at[0]], cuts_[1][at[1]], cuts_[2][at[2]]);
    const Vec3 inner = q.cwiseMax(-flat_).cwiseMin(flat_), normal = (q - inner).normalized();
    mesh.points.push_back(inner + kBlockEdge * normal);
    mesh.normals.push_back(normal);
    return entry->second;
  }

  void addFace(std::size_t axis, bool high) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::uint32_t i = 0; i < last(u); ++i) {
      for (std::uint32_t j = 0; j < last(v); ++j) {
        const auto corner = [&](std::uint32_t du, std::uint32_t dv) {
          Lattice at{};
          at[axis] = high ? last(axis) : 0;
          at[u] = i + du;
          at[v] = j + dv;
          return pointAt(at);
        };
        const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
        mesh.triangles.push_back(high ? std::array{a, b, c} : std::array{a, c, b});
        mesh.triangles.push_back(high ? std::array{a, c, d} : std::array{a, d, c});
      }
    }
  }

  Vec3 flat_;
  std::array<std::vector<double>, 3> cuts_;
  std::map<Lattice, std::uint32_t> index_;
};

TriangleMesh blockMesh(const Vec3& size) {
  TriangleMesh mesh = BlockMesh(size).mesh;
  for (Vec3& p : mesh.points) p = X_AP() * (p - Vec3(0, 0, size.z() / 2));
  for (Vec3& n : mesh.normals) n = X_AP().linear() * n;
  return mesh;
}

}  // namespace

Pose X_AP() {
  Mat3 R;
  R << 1, 0, 0,  //
      0, 0, -1,  //
      0, 1, 0;
  return makePose(R, Vec3::Zero());
}

Patient phantomBlock(const Vec3& size, const std::string& name) {
  if (!(size.minCoeff() >= kShortestSide && size.maxCoeff() <= kLongestSide) || !size.allFinite())
    throw Error("no block is " + std::to_string(1e3 * size.x()) + " x " +
                    std::to_string(1e3 * size.y()) + " x " + std::to_string(1e3 * size.z()) + " mm",
                "phantom", "Give sides from 10 mm to 2 m");
  Patient patient;
  patient.name = name;
  patient.layers = {0.002, 0, 0};
  patient.organs.push_back({"skin", Organ::skin, blockMesh(size), kBlockColour});
  patient.landmarks[landmark::kEntry] = X_AP() * Vec3::Zero();
  patient.landmarks[landmark::kNearEdge] = X_AP() * Vec3(0, -size.y() / 2, -kBlockEdge);
  return patient;
}

}  // namespace palpa::anatomy
