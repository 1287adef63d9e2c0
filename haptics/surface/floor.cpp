#include "haptics/surface/floor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "anatomy/base/quantile.h"

namespace palpa::haptics {
namespace {

constexpr int kMostPixels = 8192;  // a side: 1.3 GB
constexpr double kGaborTurn = 6.283185307179586;

std::size_t wordsOf(int size, double side) {
  if (size <= 0 || size > kMostPixels || size % GaborTable::kTile != 0)
    throw Error("a map cannot have " + std::to_string(size) + " pixels a side", "Gabor table",
                "Take a multiple of 8, at most 8192");
  if (!(side > 0) || !std::isfinite(side))
    throw Error("a map's side must be positive", "Gabor table", "Give the floor's side");
  return static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * GaborTable::kScales;
}

}  // namespace

GaborTable::GaborTable(int size, double side)
    : size_(size), side_(side), words_(wordsOf(size, side), 0) {}

void GaborTable::set(int i, int j, int direction, int scale, bool rises) noexcept {
  const std::uint32_t bit = 1u << direction;
  std::uint32_t& bits = words_[word(i, j, scale)];
  bits = rises ? bits | bit : bits & ~bit;
}

int GaborTable::directionOf(double vx, double vy) noexcept {
  const double steps = pinned::atan2(vy, vx) * (kDirections / kGaborTurn);
  if (std::isnan(steps)) return 0;
  return static_cast<int>(std::floor(steps + 0.5)) & (kDirections - 1);  // -16 is 16
}

/// By doubling instead of a logarithm: exact where a speed is just twice another.
int GaborTable::scaleOf(double speed, double first) noexcept {
  if (!(speed > 0)) return 0;
  int scale = 0;
  while (scale < kScales - 1 && speed >= std::ldexp(first, scale + 1)) ++scale;
  return scale;
}

namespace {

constexpr int kMostValleyCells = 1024;  // a side
constexpr double kUnitTangent = 1e-6;
// A point's piece of the line ends half a reach from it at most, so the middle of what is within
// reach lies within this many.
constexpr double kCellOfReach = 1.5;
constexpr double kSameLine = 3;      // usual spacings: a wider gap is a line's end
constexpr double kSameCourse = 0.7;  // cosine between the tangents of one line's neighbours

void checkValleys(const std::vector<ValleyPoint>& points, double side, double reach) {
  if (!(side > 0 && reach > 0 && std::isfinite(side) && std::isfinite(reach)))
    throw Error("side and reach must be positive", "valley map",
                "Give the floor's side, and how far its valleys are felt");
  for (const ValleyPoint& p : points) {
    const double t2 = p.tx * p.tx + p.ty * p.ty;
    if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.radius) &&
          (t2 <= 0 || std::abs(t2 - 1) < kUnitTangent)))
      throw Error("a valley point is not finite, or its tangent is neither unit nor zero",
                  "valley map",
                  "Divide tangents by their length, and leave out points without a place");
  }
}

bool directed(const ValleyPoint& p) noexcept { return p.tx * p.tx + p.ty * p.ty > 0; }

}  // namespace

ValleyMap::ValleyMap(const std::vector<ValleyPoint>& points, double side, double reach)
    : side_(side), reach_(reach), width_(std::max(kCellOfReach * reach, side / kMostValleyCells)) {
  checkValleys(points, side, reach);
  cells_ = std::clamp(static_cast<int>(std::ceil(side / width_)), 1, kMostValleyCells);
  sortByCell(points);
  measureExtents();
}

/// Clamped: what lies beyond the floor is in its outermost cells, where whoever is there looks as
/// well.
int ValleyMap::cell(double x) const noexcept {
  const double at = (x + 0.5 * side_) / width_;
  if (!(at > 0)) return 0;
  return at < cells_ ? static_cast<int>(at) : cells_ - 1;
}

void ValleyMap::sortByCell(const std::vector<ValleyPoint>& points) {
  const auto cellOf = [this](const ValleyPoint& p) {
    return static_cast<std::size_t>(cell(p.y) * cells_ + cell(p.x));
  };
  first_.assign(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_) + 1, 0);
  for (const ValleyPoint& p : points) ++first_[cellOf(p) + 1];
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  points_.resize(points.size());
  for (const ValleyPoint& p : points) points_[static_cast<std::size_t>(next[cellOf(p)]++)] = p;
}

template <typename Visit>
void ValleyMap::around(double x, double y, Visit visit) const noexcept {
  const int i = cell(x), j = cell(y);
  for (int row = std::max(j - 1, 0); row <= std::min(j + 1, cells_ - 1); ++row) {
    const int begin = first_[static_cast<std::size_t>(row * cells_ + std::max(i - 1, 0))],
              end =
                  first_[static_cast<std::size_t>(row * cells_ + std::min(i + 1, cells_ - 1)) + 1];
    for (int k = begin; k < end; ++k) visit(static_cast<std::size_t>(k));
  }
}

ValleyMap::ValleyExtent ValleyMap::gaps(const ValleyPoint& point) const noexcept {
  ValleyExtent gap;
  around(point.x, point.y, [&](std::size_t k) {
    const ValleyPoint& other = points_[k];
    if (std::abs(point.tx * other.tx + point.ty * other.ty) < kSameCourse) return;
    const double dx = other.x - point.x, dy = other.y - point.y;
    const double along = dx * point.tx + dy * point.ty, across = dy * point.tx - dx * point.ty;
    if (std::abs(along) <= std::abs(across) || dx * dx + dy * dy > reach_ * reach_) return;
    double& side = along > 0 ? gap.ahead : gap.behind;
    if (side <= 0 || std::abs(along) < side) side = std::abs(along);
  });
  return gap;
}

void ValleyMap::measureExtents() {
  std::vector<double> all;
  for (const ValleyPoint& p : points_) {
    extents_.push_back(directed(p) ? gaps(p) : ValleyExtent{});
    for (const double gap : {extents_.back().behind, extents_.back().ahead})
      if (gap > 0) all.push_back(gap);
  }
  if (all.empty()) return;
  const double widest = kSameLine * upperMedian(std::move(all));
  for (ValleyExtent& e : extents_)
    e = {e.behind > widest ? 0 : 0.5 * e.behind, e.ahead > widest ? 0 : 0.5 * e.ahead};
}

NearestValley ValleyMap::nearest(double x, double y) const noexcept {
  NearestValley best;
  double best2 = reach_ * reach_;
  around(x, y, [&](std::size_t k) {
    const ValleyPoint& p = points_[k];
    const double px = p.x - x, py = p.y - y;
    const double along =
        std::clamp(-(px * p.tx + py * p.ty), -extents_[k].behind, extents_[k].ahead);
    const double dx = px + along * p.tx, dy = py + along * p.ty, d2 = dx * dx + dy * dy;
    if (!(d2 <= best2)) return;
    best2 = d2;
    best = {true, dx, dy, 0, p.radius};
  });
  best.distance = best.found ? std::sqrt(best2) : 0;
  return best;
}

}  // namespace palpa::haptics
