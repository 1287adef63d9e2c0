#pragma once

#include <vector>

namespace palpa::haptics {

/// A piece of a surface's valley: a point where the slope is zero along the most concave principal
/// direction; lengths in U, in F.
struct ValleyPoint {
  double x = 0, y = 0;
  double tx = 0, ty = 0;  ///< unit, along the valley; both 0 for a pit, which has no direction
  double radius = 0;      ///< of curvature across the valley
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
  ValleyMap(std::vector<ValleyPoint> points, double side, double reach);

  struct Nearest {
    bool found = false;
    double dx = 0, dy = 0;  ///< from (x, y) to the valley
    double distance = 0, radius = 0;
  };
  Nearest nearest(double x, double y) const noexcept;
  double reach() const noexcept { return reach_; }
  const std::vector<ValleyPoint>& points() const noexcept { return points_; }  ///< by cell

 private:
  struct Extent {
    double behind = 0, ahead = 0;  ///< along the tangent
  };

  int cell(double x) const noexcept;
  void sortByCell(const std::vector<ValleyPoint>& points);
  Extent gaps(
      const ValleyPoint& point) const noexcept;  ///< to the next points behind and ahead; 0: none
  void measureExtents();
  /// Calls `visit(k)` for every point in the cells around (x, y).
  template <typename Visit>
  void around(double x, double y, Visit visit) const noexcept;

  double side_, reach_, width_;  ///< of a cell
  int cells_ = 0;
  std::vector<ValleyPoint> points_;
  std::vector<Extent> extents_;
  std::vector<int> first_;  ///< of each cell in `points_`, and one more
};

}  // namespace palpa::haptics
