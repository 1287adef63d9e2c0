#include "anatomy/shapes/spline.h"

#include <algorithm>

namespace palpa::anatomy {
namespace {

std::vector<double> chainLengths(const std::vector<Vec3>& points) {
  std::vector<double> s(points.size(), 0);
  for (std::size_t i = 1; i < points.size(); ++i)
    s[i] = s[i - 1] + (points[i] - points[i - 1]).norm();
  return s;
}

std::vector<Spline::Knot> component(const std::vector<Vec3>& points, int axis) {
  const std::vector<double> s = chainLengths(points);
  std::vector<Spline::Knot> knots(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) knots[i] = {s[i], points[i][axis]};
  return knots;
}

}  // namespace

Spline::Spline(const std::vector<Knot>& knots) : knots_(knots), second_(knots.size(), 0) {
  // Thomas algorithm for the natural end conditions.
  const std::size_t n = knots_.size();
  std::vector<double> c(n, 0), d(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = knots_[i].t - knots_[i - 1].t, h1 = knots_[i + 1].t - knots_[i].t;
    const double slopes =
        (knots_[i + 1].value - knots_[i].value) / h1 - (knots_[i].value - knots_[i - 1].value) / h0;
    const double pivot = 2 * (h0 + h1) - h0 * c[i - 1];
    c[i] = h1 / pivot;
    d[i] = (6 * slopes - h0 * d[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) second_[i] = d[i] - c[i] * second_[i + 1];
}

double Spline::operator()(double t) const {
  if (t <= knots_.front().t) return knots_.front().value;
  if (t >= knots_.back().t) return knots_.back().value;
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), t,
                                      [](double x, const Knot& k) { return x < k.t; });
  const std::size_t i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double h = knots_[i + 1].t - knots_[i].t;
  const double b = (t - knots_[i].t) / h, a = 1 - b;
  return a * knots_[i].value + b * knots_[i + 1].value +
         ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[i + 1]) * h * h / 6;
}

Curve::Curve(const std::vector<Vec3>& points)
    : length_(chainLengths(points).back()),
      x_(component(points, 0)),
      y_(component(points, 1)),
      z_(component(points, 2)) {}

Vec3 Curve::tangent(double s) const {
  const double h = 1e-4 * length_;
  const double a = std::max(0.0, s - h), b = std::min(length_, s + h);
  return ((*this)(b) - (*this)(a)).normalized();
}

std::vector<Vec3> Curve::sample(int count) const {
  std::vector<Vec3> points(count);
  for (int i = 0; i < count; ++i) points[i] = (*this)(length_ * i / (count - 1));
  return points;
}

}  // namespace palpa::anatomy
