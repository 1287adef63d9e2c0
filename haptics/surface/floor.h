#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "haptics/surface/search_surface.h"

namespace palpa::haptics {

/// Where a surface rises under a probe that moves in one of 32 directions at one of five scales: a
/// bit each for every pixel of a square height map, set where the response of the antisymmetric
/// Gabor filter of that direction and scale exceeds its threshold. 160 bits a pixel, pixels in
/// tiles of 8 x 8, so that a moving probe stays in a tile: 1024 x 1024 pixels are 20,971,520 bytes.
/// Looking up neither allocates nor locks. Pixel (i, j) has its middle at
/// x = (i + 0.5) side / size - side / 2, y likewise.
class GaborTable {
 public:
  static constexpr int kDirections = 32, kScales = 5, kTile = 8;

  /// `size` pixels a side, a multiple of 8; `side` in U. Throws Error.
  GaborTable(int size, double side);

  int size() const noexcept { return size_; }
  double side() const noexcept { return side_; }
  std::size_t bytes() const noexcept { return words_.size() * sizeof(std::uint32_t); }

  void set(int i, int j, int direction, int scale, bool rises) noexcept;
  bool pixel(int i, int j, int direction, int scale) const noexcept {
    return words_[word(i, j, scale)] >> direction & 1u;
  }
  /// Of the pixel under (x, y); false beyond the map.
  bool rises(double x, double y, int direction, int scale) const noexcept {
    const double u = (x / side_ + 0.5) * size_, v = (y / side_ + 0.5) * size_;
    if (!(u >= 0 && v >= 0 && u < size_ && v < size_)) return false;
    return pixel(static_cast<int>(u), static_cast<int>(v), direction, scale);
  }

  /// Index of the direction 2 pi k / 32 nearest to (vx, vy), not both 0.
  static int directionOf(double vx, double vy) noexcept;
  /// clamp(floor(log2(v / v_0)), 0, 4): of a speed v, where v_0 is the one at which scanning
  /// begins.
  static int scaleOf(double speed, double first) noexcept;

 private:
  std::size_t word(int i, int j, int scale) const noexcept {
    const std::size_t tile = static_cast<std::size_t>((j / kTile) * (size_ / kTile) + i / kTile);
    return (tile * kTile * kTile + static_cast<std::size_t>((j % kTile) * kTile + i % kTile)) *
               kScales +
           static_cast<std::size_t>(scale);
  }

  int size_;
  double side_;
  std::vector<std::uint32_t> words_;
};

/// A piece of a surface's valley: a point where the slope is zero along the most concave principal
/// direction; lengths in U, in F.
struct ValleyPoint {
  double x = 0, y = 0;
  double tx = 0, ty = 0;  ///< unit, along the valley; both 0 for a pit, which has no direction
  double radius = 0;      ///< of curvature across the valley
};

/// The valley that is nearest to a point (x, y), in U.
struct NearestValley {
  bool found = false;
  double dx = 0, dy = 0;  ///< from (x, y) to the valley
  double distance = 0, radius = 0;
};

/// Valley points in square cells somewhat wider than one looks: the nearest one in constant time.
/// Between two points of a line it is the line's own: a point with a tangent stands for the piece
/// of it from half way to the point behind to half way to the point ahead, so the distance does not
/// ripple; on a valley with radius R and points s apart it errs by s^2 / (8 R). A neighbour counts
/// up to `reach`, and up to three times the line's usual spacing. Reading neither allocates nor
/// locks.
class ValleyMap {
 public:
  /// `side` of the square floor around the origin; nothing farther than `reach` is ever found.
  /// Throws Error for what is not finite, and for tangents that are neither unit nor 0.
  ValleyMap(const std::vector<ValleyPoint>& points, double side, double reach);

  NearestValley nearest(double x, double y) const noexcept;
  double reach() const noexcept { return reach_; }
  const std::vector<ValleyPoint>& points() const noexcept { return points_; }  ///< by cell

 private:
  struct ValleyExtent {
    double behind = 0, ahead = 0;  ///< along the tangent
  };

  int cell(double x) const noexcept;
  void sortByCell(const std::vector<ValleyPoint>& points);
  ValleyExtent gaps(
      const ValleyPoint& point) const noexcept;  ///< to the next points behind and ahead; 0: none
  void measureExtents();
  /// Calls `visit(k)` for every point in the cells around (x, y).
  template <typename Visit>
  void around(double x, double y, Visit visit) const noexcept;

  double side_, reach_, width_;  ///< of a cell
  int cells_ = 0;
  std::vector<ValleyPoint> points_;
  std::vector<ValleyExtent> extents_;
  std::vector<int> first_;  ///< of each cell in `points_`, and one more
};

/// A floor to be searched, with what its augmentations need to know of it; all of it fixed while a
/// tick may look at it.
struct Floor {
  const SearchSurface* surface = nullptr;
  const GaborTable* rises = nullptr;   ///< null: nothing rises
  const ValleyMap* valleys = nullptr;  ///< null: nothing attracts
};

}  // namespace palpa::haptics
