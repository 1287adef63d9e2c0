#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

/// Natural cubic spline (C2) through values at increasing knots; outside the knots the end value.
class Spline {
 public:
  struct Knot {
    double t, value;
  };
  Spline(std::initializer_list<Knot> knots) : Spline(std::vector<Knot>(knots)) {}
  explicit Spline(const std::vector<Knot>& knots);
  double operator()(double t) const;

 private:
  std::vector<Knot> knots_;
  std::vector<double> second_;  ///< second derivatives at the knots
};

/// Smooth curve through points, parameterised by the length of the chain through them.
class Curve {
 public:
  explicit Curve(const std::vector<Vec3>& points);
  double length() const { return length_; }
  Vec3 operator()(double s) const { return {x_(s), y_(s), z_(s)}; }
  Vec3 tangent(double s) const;
  /// `count` points at equal steps of the parameter, both ends included.
  std::vector<Vec3> sample(int count) const;

 private:
  double length_;
  Spline x_, y_, z_;
};

}  // namespace palpa::anatomy
