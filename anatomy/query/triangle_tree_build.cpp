#include "anatomy/query/triangle_tree_build.h"

#include <algorithm>

#include "anatomy/base/pinned_math.h"
#include "anatomy/query/triangle_tree.h"

namespace palpa::anatomy {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr std::uint32_t kLeafSize = 6;
constexpr int kBins = 16;
constexpr int kUneven = 24;  // levels; below, ranges are halved: at most 15 levels more

// Of the largest coordinate about the middle: single precision rounds boxes and queries by less
// than this.
constexpr double kMargin = 4 * 6e-8;

double area(const Box& box) {
  if (box.isEmpty()) return 0;
  const Vec3 d = box.sizes();
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

struct Bins {
  std::array<Box, kBins> box;
  std::array<std::uint32_t, kBins> count{};
};

/// Bin after which to cut, and what that costs: area times number, both sides. -1 when one side is
/// always empty.
std::pair<int, double> cheapest(const Bins& bins) {
  std::array<double, kBins> right{};
  Box box;
  std::uint32_t count = 0;
  for (int i = kBins - 1; i > 0; --i) {
    box.extend(bins.box[i]);
    count += bins.count[i];
    right[i - 1] = area(box) * count;
  }
  const std::uint32_t all = count + bins.count[0];
  std::pair<int, double> best{-1, 0};
  box = Box();
  count = 0;
  for (int i = 0; i + 1 < kBins; ++i) {
    box.extend(bins.box[i]);
    count += bins.count[i];
    if (count == 0 || count == all) continue;
    const double cost = area(box) * count + right[i];
    if (best.first < 0 || cost < best.second) best = {i, cost};
  }
  return best;
}

}  // namespace

TriangleTreeBuilder::TriangleTreeBuilder(TriangleTree& tree) : tree_(tree) {
  const auto count = static_cast<std::uint32_t>(tree.triangles_.size());
  for (const auto& t : tree.triangles_) {
    Box box(tree.points_[t[0]]);
    box.extend(tree.points_[t[1]]).extend(tree.points_[t[2]]);
    boxes_.push_back(box);
    centres_.push_back(box.center());
    order_.push_back(static_cast<std::uint32_t>(order_.size()));
    tree.bounds_.extend(box);
  }
  if (count > 0) tree.centre_ = tree.bounds_.center();
  margin_ = kMargin * (tree.bounds_.isEmpty() ? 0 : tree.bounds_.sizes().maxCoeff());
  tree.nodes_.reserve(count / 2 + 1);
  build({0, count}, 0);
  settle();
}

Box TriangleTreeBuilder::boxOf(const Range& range) const {
  Box box;
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i)
    box.extend(boxes_[order_[i]]);
  return box;
}

std::uint32_t TriangleTreeBuilder::build(Range range, int level) {
  std::array<Range, 4> parts{range};
  int count = range.count > 0 ? 1 : 0;
  while (count > 0 && count < 4) {
    const auto largest =
        std::max_element(parts.begin(), parts.begin() + count,
                         [](const Range& a, const Range& b) { return a.count < b.count; });
    if (largest->count <= kLeafSize) break;
    parts[count] = cut(&*largest, level);
    ++count;
  }
  const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
  TriangleTree::Node node;
  const float far = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    node.low[axis].setConstant(far);
    node.high[axis].setConstant(-far);
  }
  node.child.fill(TriangleTree::kLeaf);
  for (int lane = 0; lane < count; ++lane) {
    const Box box = boxOf(parts[lane]);
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][lane] = static_cast<float>(box.min()[axis] - tree_.centre_[axis] - margin_);
      node.high[axis][lane] = static_cast<float>(box.max()[axis] - tree_.centre_[axis] + margin_);
    }
  }
  tree_.nodes_.push_back(node);
  for (int lane = 0; lane < count; ++lane) {
    const Range& part = parts[lane];
    const std::uint32_t child =
        part.count <= kLeafSize
            ? TriangleTree::kLeaf | part.count << TriangleTree::kCountShift | part.first
            : build(part, level + 1);
    tree_.nodes_[index].child[lane] = child;
  }
  return index;
}

/// Leaves the first part in `range` and returns the rest.
TriangleTreeBuilder::Range TriangleTreeBuilder::cut(Range* range, int level) {
  Box centres;
  for (std::uint32_t i = range->first; i < range->first + range->count; ++i)
    centres.extend(centres_[order_[i]]);
  std::uint32_t kept = level < kUneven ? bestCut(*range, centres) : 0;
  if (kept == 0) kept = halve(*range, centres);
  const Range rest{range->first + kept, range->count - kept};
  range->count = kept;
  return rest;
}

/// Binned surface-area heuristic; 0 where all centres fall together.
std::uint32_t TriangleTreeBuilder::bestCut(const Range& range, const Box& centres) {
  const auto binOf = [&](std::uint32_t triangle, int axis) {
    const double part = (centres_[triangle][axis] - centres.min()[axis]) / centres.sizes()[axis];
    return std::clamp(static_cast<int>(part * kBins), 0, kBins - 1);
  };
  int best_axis = -1;
  std::pair<int, double> best;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(centres.sizes()[axis] > 0)) continue;
    Bins bins;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const int bin = binOf(order_[i], axis);
      bins.box[bin].extend(boxes_[order_[i]]);
      ++bins.count[bin];
    }
    const auto found = cheapest(bins);
    if (found.first < 0 || (best_axis >= 0 && found.second >= best.second)) continue;
    best_axis = axis;
    best = found;
  }
  if (best_axis < 0) return 0;
  const auto begin = order_.begin() + range.first;
  const auto end = std::stable_partition(begin, begin + range.count, [&](std::uint32_t triangle) {
    return binOf(triangle, best_axis) <= best.first;
  });
  return static_cast<std::uint32_t>(end - begin);
}

std::uint32_t TriangleTreeBuilder::halve(const Range& range, const Box& centres) {
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::uint32_t half = range.count / 2;
  const auto begin = order_.begin() + range.first;
  std::nth_element(begin, begin + half, begin + range.count, [&](std::uint32_t a, std::uint32_t b) {
    const double x = centres_[a][axis], y = centres_[b][axis];
    return x < y || (x == y && a < b);
  });
  return half;
}

void TriangleTreeBuilder::settle() {
  std::vector<TriangleTree::Corners> triangles;
  std::vector<bool> used(tree_.points_.size(), false);
  triangles.reserve(order_.size());
  for (const std::uint32_t i : order_) {
    const TriangleTree::Corners& t = tree_.triangles_[i];
    std::uint8_t first = 0;
    for (int k = 0; k < 3; ++k) {
      if (used[t[k]]) continue;
      used[t[k]] = true;
      first = static_cast<std::uint8_t>(first | 1 << k);
    }
    triangles.push_back(t);
    tree_.first_use_.push_back(first);
    tree_.corners_.push_back({tree_.points_[t[0]], tree_.points_[t[1]], tree_.points_[t[2]]});
  }
  tree_.triangles_ = std::move(triangles);
}

namespace {

double cornerAngle(const Vec3& corner, const Vec3& p, const Vec3& q) {
  const Vec3 u = p - corner, v = q - corner;
  return pinned::atan2(u.cross(v).norm(), u.dot(v));
}

/// A triangle's edge, so that the same edge of its neighbours sorts beside it.
struct EdgeUse {
  std::uint32_t low, high, triangle;
  int k;
  bool operator<(const EdgeUse& o) const {
    return low != o.low ? low < o.low : high != o.high ? high < o.high : triangle < o.triangle;
  }
};

}  // namespace

void TriangleTree::makePseudonormals() {
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  face_normals_.resize(count);
  vertex_pseudonormals_.assign(points_.size(), Vec3::Zero());
  edge_pseudonormals_.resize(count);
  std::vector<EdgeUse> uses;
  uses.reserve(3 * std::size_t{count});
  for (std::uint32_t i = 0; i < count; ++i) {
    const Corners& t = triangles_[i];
    const auto& [a, b, c] = corners_[i];
    const Vec3 n = face_normals_[i] = (b - a).cross(c - a).normalized();
    vertex_pseudonormals_[t[0]] += n * cornerAngle(a, b, c);
    vertex_pseudonormals_[t[1]] += n * cornerAngle(b, c, a);
    vertex_pseudonormals_[t[2]] += n * cornerAngle(c, a, b);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), i, k});
    }
  }
  std::sort(uses.begin(), uses.end());
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    Vec3 sum = Vec3::Zero();
    for (; end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high;
         ++end)
      sum += face_normals_[uses[end].triangle];
    for (std::size_t use = begin; use < end; ++use)
      edge_pseudonormals_[uses[use].triangle][uses[use].k] = sum;
  }
}

}  // namespace palpa::anatomy
