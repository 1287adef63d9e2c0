#pragma once

#include <functional>
#include <vector>

#include "anatomy/geometry/pose.h"

/// Shapes as functions: negative inside, zero on the surface, growing about as the distance does.
namespace palpa::anatomy {

using Field = std::function<double(const Vec3&)>;

/// Union and intersection with a fillet about `k` wide (polynomial, Quilez 2013); k > 0.
double smoothMin(double a, double b, double k);
double smoothMax(double a, double b, double k);

/// Tube of varying radius along a chain of points.
class TubeField {
 public:
  struct Station {
    Vec3 p;
    double radius;
  };
  explicit TubeField(std::vector<Station> stations);
  double operator()(const Vec3& p) const;
  const std::vector<Station>& stations() const { return stations_; }

 private:
  std::vector<Station> stations_;
};

Vec3 gradient(const Field& field, const Vec3& p, double step);

}  // namespace palpa::anatomy
