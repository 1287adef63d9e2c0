#include "anatomy/query/skin_dimple.h"

#include <algorithm>
#include <cmath>

#include "anatomy/query/triangle_tree.h"

namespace palpa::anatomy {
namespace {

constexpr double kLeastShare = 0.1;
constexpr double kAway =
    0.2;  // cosine: a vertex whose normal turns away more lies on another sheet
constexpr double kNothing = 1e-7;  // m: not a dimple

}  // namespace

struct SkinDimple::Impl {
  TriangleTree tree;
  SkinDeflection deflection;
  std::vector<Vertex> moved;
};

SkinDimple::SkinDimple(const TriangleMesh& skin, const SkinDeflection::Settings& settings)
    : impl_(new Impl{TriangleTree(skin), SkinDeflection(settings), {}}) {}

SkinDimple::~SkinDimple() = default;

std::span<const SkinDimple::Vertex> SkinDimple::press(const SkinPush& push) {
  Impl& own = *impl_;
  own.moved.clear();
  if (!(std::abs(push.depth) > kNothing) || !push.p_A.allFinite()) return {};
  const Vec3 x = push.n_A.unitOrthogonal(), y = push.n_A.cross(x);
  const auto inPlane = [&](const Vec3& v) { return Vec2(v.dot(x), v.dot(y)); };
  own.deflection.update(push.depth, inPlane(push.lean_A));
  const TriangleTree::Closest foot = own.tree.closest(push.p_A);
  const auto moves = [&](std::uint32_t i) { return own.tree.normals()[i].dot(push.n_A) > kAway; };
  double share = 0;
  for (int k = 0; k < 3; ++k)
    if (moves(foot.corners[k]))
      share += foot.weights[k] *
               own.deflection.at(inPlane(own.tree.points()[foot.corners[k]] - push.p_A)).depth /
               push.depth;
  const double factor = 1 / std::max(share, kLeastShare);
  own.tree.forVerticesWithin(push.p_A, own.deflection.settings().patch, [&](std::uint32_t i) {
    if (!moves(i)) return;
    const Vec3 &p = own.tree.points()[i], &n = own.tree.normals()[i];
    const SkinDeflection::Sample sample = own.deflection.at(inPlane(p - push.p_A));
    if (sample.depth == 0) return;
    const Vec2 slope = factor * sample.slope;
    // x -> x - w(x) n turns a normal m into m + (n . m) grad w.
    const Vec3 turned = n + n.dot(push.n_A) * (slope.x() * x + slope.y() * y);
    own.moved.push_back({i, p - factor * sample.depth * push.n_A, turned.normalized()});
  });
  return own.moved;
}

}  // namespace palpa::anatomy
