#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "anatomy/base/pinned_math.h"
#include "anatomy/geometry/pose.h"
#include "anatomy/patient.h"

/// Shapes as functions: negative inside, zero on the surface, growing about as the distance does.
namespace palpa::anatomy {

using Field = std::function<double(const Vec3&)>;

/// Union and intersection with a fillet about `k` wide (polynomial, Quilez 2013); k > 0.
double smoothMin(double a, double b, double k);
double smoothMax(double a, double b, double k);

/// From 0 to 1 about x = 0, half of it within 0.55 `width`.
inline double softStep(double x, double width) { return 0.5 * (1 + pinned::tanh(x / width)); }

/// A point of a tube's middle line with the radius there, m.
struct TubeStation {
  Vec3 p;
  double radius;
};

/// Tube of varying radius along a chain of points. Spans are kept in bundles with a sphere around
/// each, so that most are never looked at.
class TubeField {
 public:
  explicit TubeField(std::vector<TubeStation> stations);
  double operator()(const Vec3& p) const;
  /// No more than the distance there; cheap.
  double atLeast(const Vec3& p) const { return box_.exteriorDistance(p); }
  const std::vector<TubeStation>& stations() const { return stations_; }

 private:
  struct TubeSpan {
    Vec3 from, along;  ///< along: to the next station, divided by its squared length
    Vec3 whole;        ///< to the next station
    double radius, growth;
  };
  struct Bundle {
    Vec3 centre;
    double reach;  ///< no point of the tube in this bundle lies farther from the centre
    std::size_t begin, end;
  };
  std::vector<TubeStation> stations_;
  std::vector<TubeSpan> spans_;
  std::vector<Bundle> bundles_;
  Eigen::AlignedBox3d box_;
};

/// smoothMin(f, tube(p) - grow, k) and smoothMax(f, gap - tube(p), k), asking the tube only where
/// it counts.
double addTube(double f, const TubeField& tube, const Vec3& p, double grow, double k);
double carveTube(double f, const TubeField& tube, const Vec3& p, double gap, double k);

Vec3 gradient(const Field& field, const Vec3& p, double step);

/// Closed mesh of a field's zero surface inside `box`, which must hold it with a cell to spare
/// (Gibson 1998: one vertex in every cell that the surface cuts, one quad across every cut edge).
/// Vertices are then moved onto the surface by Newton steps; normals are the field's gradient.
/// The field may grow at most `slope` times as fast as distance: far cells are skipped by that.
TriangleMesh surfaceNets(const Field& field, const Eigen::AlignedBox3d& box, double cell,
                         double slope = 2);

}  // namespace palpa::anatomy
