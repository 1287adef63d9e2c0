#include "anatomy/volume/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace palpa::anatomy {
namespace {

constexpr double kNowhere = 1;  // metres: farther than any voxel of a body
constexpr std::array<Index3, 6> kFaces{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

Index3 moved(const Index3& c, const Index3& d) { return {c[0] + d[0], c[1] + d[1], c[2] + d[2]}; }

/// Lower envelope of the parabolas f[n] + (step (x - n))^2, sampled back into f.
class Envelope {
 public:
  explicit Envelope(std::size_t longest) : place_(longest), border_(longest + 1), old_(longest) {}

  void apply(double* f, int n, double step) {
    std::copy(f, f + n, old_.begin());
    int top = -1;
    for (int q = 0; q < n; ++q) {
      if (old_[static_cast<std::size_t>(q)] >= kNowhere * kNowhere) continue;
      double from = -std::numeric_limits<double>::infinity();
      while (top >= 0) {
        from = meeting(place_[static_cast<std::size_t>(top)], q, step);
        if (from > border_[static_cast<std::size_t>(top)]) break;
        --top;
        from = -std::numeric_limits<double>::infinity();
      }
      ++top;
      place_[static_cast<std::size_t>(top)] = q;
      border_[static_cast<std::size_t>(top)] = from;
    }
    if (top < 0) return;
    for (int x = 0, at = 0; x < n; ++x) {
      while (at < top && border_[static_cast<std::size_t>(at) + 1] < x) ++at;
      const int p = place_[static_cast<std::size_t>(at)];
      f[x] = old_[static_cast<std::size_t>(p)] + step * step * (x - p) * (x - p);
    }
  }

 private:
  double meeting(int p, int q, double step) const {
    const double s = step * step;
    return (old_[static_cast<std::size_t>(q)] - old_[static_cast<std::size_t>(p)]) /
               (2 * s * (q - p)) +
           0.5 * (p + q);
  }
  std::vector<int> place_;
  std::vector<double> border_, old_;
};

/// Calls visit(first, stride, length) for each line of the grid along `axis`.
template <class Visit>
void forLines(const VoxelGrid& grid, std::size_t axis, Visit visit) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(grid.size[0]),
      static_cast<std::size_t>(grid.size[0]) * static_cast<std::size_t>(grid.size[1])};
  for (int b = 0; b < grid.size[v]; ++b)
    for (int a = 0; a < grid.size[u]; ++a)
      visit(static_cast<std::size_t>(a) * stride[u] + static_cast<std::size_t>(b) * stride[v],
            stride[axis], grid.size[axis]);
}

/// What is not reached from the border of one slice across `axis`.
void fillSlice(const VoxelGrid& grid, const Mask& mask, std::size_t axis, int slice, Mask* out) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int nu = grid.size[u], nv = grid.size[v];
  const auto voxel = [&](int a, int b) {
    Index3 c{};
    c[axis] = slice, c[u] = a, c[v] = b;
    return grid.index(c);
  };
  Mask outside(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv), 0);
  std::vector<std::pair<int, int>> stack;
  const auto visit = [&](int a, int b) {
    if (a < 0 || b < 0 || a >= nu || b >= nv) return;
    std::uint8_t& seen = outside[static_cast<std::size_t>(b) * static_cast<std::size_t>(nu) +
                                 static_cast<std::size_t>(a)];
    if (seen || mask[voxel(a, b)]) return;
    seen = 1;
    stack.emplace_back(a, b);
  };
  for (int a = 0; a < nu; ++a) visit(a, 0), visit(a, nv - 1);
  for (int b = 0; b < nv; ++b) visit(0, b), visit(nu - 1, b);
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    visit(a - 1, b), visit(a + 1, b), visit(a, b - 1), visit(a, b + 1);
  }
  for (int b = 0; b < nv; ++b)
    for (int a = 0; a < nu; ++a)
      if (!outside[static_cast<std::size_t>(b) * static_cast<std::size_t>(nu) +
                   static_cast<std::size_t>(a)])
        (*out)[voxel(a, b)] = 1;
}

}  // namespace

Values distanceTo(const VoxelGrid& grid, const Mask& mask) {
  Values squared(mask.size());
  for (std::size_t n = 0; n < mask.size(); ++n)
    squared[n] = mask[n] ? 0.f : static_cast<float>(kNowhere * kNowhere);
  const auto longest =
      static_cast<std::size_t>(*std::max_element(grid.size.begin(), grid.size.end()));
  Envelope envelope(longest);
  std::vector<double> line(longest);
  for (std::size_t axis = 0; axis < 3; ++axis)
    forLines(grid, axis, [&](std::size_t first, std::size_t stride, int n) {
      for (int i = 0; i < n; ++i)
        line[static_cast<std::size_t>(i)] = squared[first + static_cast<std::size_t>(i) * stride];
      envelope.apply(line.data(), n, grid.spacing[static_cast<int>(axis)]);
      for (int i = 0; i < n; ++i)
        squared[first + static_cast<std::size_t>(i) * stride] =
            static_cast<float>(line[static_cast<std::size_t>(i)]);
    });
  for (float& d : squared) d = std::sqrt(d);
  return squared;
}

Values signedDistance(const VoxelGrid& grid, const Mask& mask) {
  Values out = distanceTo(grid, mask);
  const Values in = distanceTo(grid, inverted(mask));
  const auto half = static_cast<float>(grid.spacing.minCoeff() / 2);
  for (std::size_t n = 0; n < out.size(); ++n) out[n] = mask[n] ? half - in[n] : out[n] - half;
  return out;
}

Mask inverted(const Mask& mask) {
  Mask out(mask.size());
  for (std::size_t n = 0; n < mask.size(); ++n) out[n] = !mask[n];
  return out;
}

Mask dilated(const VoxelGrid& grid, const Mask& mask, double radius) {
  const Values distance = distanceTo(grid, mask);
  Mask out(mask.size());
  for (std::size_t n = 0; n < mask.size(); ++n) out[n] = distance[n] <= radius;
  return out;
}

Mask eroded(const VoxelGrid& grid, const Mask& mask, double radius) {
  return inverted(dilated(grid, inverted(mask), radius));
}

Values blurred(const VoxelGrid& grid, Values values, double sigma) {
  std::vector<double> kernel, line;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double s = sigma / grid.spacing[static_cast<int>(axis)];
    const int reach = static_cast<int>(std::ceil(3 * s));
    if (reach < 1 || s < 0.2) continue;
    kernel.assign(static_cast<std::size_t>(2 * reach + 1), 0);
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
      sum += kernel[static_cast<std::size_t>(i + reach)] = std::exp(-0.5 * i * i / (s * s));
    forLines(grid, axis, [&](std::size_t first, std::size_t stride, int n) {
      line.resize(static_cast<std::size_t>(n + 2 * reach));
      for (int i = 0; i < n + 2 * reach; ++i)
        line[static_cast<std::size_t>(i)] =
            values[first + static_cast<std::size_t>(std::clamp(i - reach, 0, n - 1)) * stride];
      for (int i = 0; i < n; ++i) {
        double total = 0;
        for (int t = 0; t <= 2 * reach; ++t)
          total += kernel[static_cast<std::size_t>(t)] * line[static_cast<std::size_t>(i + t)];
        values[first + static_cast<std::size_t>(i) * stride] = static_cast<float>(total / sum);
      }
    });
  }
  return values;
}

VoxelPieces piecesOf(const VoxelGrid& grid, const Mask& mask) {
  VoxelPieces pieces{std::vector<std::int32_t>(mask.size(), 0), {0}};
  std::vector<std::size_t> stack;
  for (std::size_t first = 0; first < mask.size(); ++first) {
    if (!mask[first] || pieces.label[first]) continue;
    const auto number = static_cast<std::int32_t>(pieces.voxels.size());
    pieces.voxels.push_back(0);
    pieces.label[first] = number;
    stack.push_back(first);
    while (!stack.empty()) {
      const Index3 c = grid.cell(stack.back());
      stack.pop_back();
      ++pieces.voxels.back();
      for (const Index3& d : kFaces) {
        const Index3 next = moved(c, d);
        if (!grid.holds(next)) continue;
        const std::size_t n = grid.index(next);
        if (!mask[n] || pieces.label[n]) continue;
        pieces.label[n] = number;
        stack.push_back(n);
      }
    }
  }
  return pieces;
}

Mask largestPiece(const VoxelGrid& grid, const Mask& mask) {
  const VoxelPieces pieces = piecesOf(grid, mask);
  const auto most =
      std::max_element(pieces.voxels.begin(), pieces.voxels.end()) - pieces.voxels.begin();
  Mask out(mask.size(), 0);
  for (std::size_t n = 0; n < mask.size(); ++n) out[n] = most > 0 && pieces.label[n] == most;
  return out;
}

Mask filledAcross(const VoxelGrid& grid, const Mask& mask, std::size_t axis) {
  Mask out = mask;
  for (int slice = 0; slice < grid.size[axis]; ++slice) fillSlice(grid, mask, axis, slice, &out);
  return out;
}

Mask filled(const VoxelGrid& grid, const Mask& mask, bool by_slices) {
  Mask out = mask;
  if (by_slices) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int slice = 0; slice < grid.size[axis]; ++slice)
        fillSlice(grid, mask, axis, slice, &out);
    return out;
  }
  const VoxelPieces outside = piecesOf(grid, inverted(mask));
  std::vector<bool> open(outside.voxels.size(), false);
  for (std::size_t n = 0; n < mask.size(); ++n)
    if (outside.label[n] && grid.atBorder(grid.cell(n)))
      open[static_cast<std::size_t>(outside.label[n])] = true;
  for (std::size_t n = 0; n < mask.size(); ++n)
    if (outside.label[n] && !open[static_cast<std::size_t>(outside.label[n])]) out[n] = 1;
  return out;
}

std::vector<std::int32_t> grown(const VoxelGrid& grid, std::vector<std::int32_t> markers,
                                const Mask& within, double reach) {
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  Values way(markers.size(), std::numeric_limits<float>::infinity());
  for (std::size_t n = 0; n < markers.size(); ++n)
    if (markers[n]) {
      way[n] = 0;
      queue.emplace(0.f, n);
    }
  while (!queue.empty()) {
    const auto [so_far, at] = queue.top();
    queue.pop();
    if (so_far > way[at]) continue;
    const Index3 c = grid.cell(at);
    for (std::size_t d = 0; d < kFaces.size(); ++d) {
      const Index3 next = moved(c, kFaces[d]);
      if (!grid.holds(next)) continue;
      const std::size_t n = grid.index(next);
      const float there = so_far + static_cast<float>(grid.spacing[static_cast<int>(d / 2)]);
      if (!within[n] || there >= way[n] || there > static_cast<float>(reach)) continue;
      way[n] = there;
      markers[n] = markers[at];
      queue.emplace(there, n);
    }
  }
  return markers;
}

}  // namespace palpa::anatomy
