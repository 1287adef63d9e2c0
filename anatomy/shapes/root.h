#pragma once

#include <cmath>

namespace palpa::anatomy {

/// Root of f between a and b (Illinois variant of the false position, Dowell and Jarratt 1971) to
/// `tolerance` in the argument. Where f has one sign at both ends, the end with the smaller |f|.
template <typename Function>
double findRoot(Function f, double a, double b, double tolerance) {
  double fa = f(a), fb = f(b);
  if (fa * fb > 0) return std::abs(fa) < std::abs(fb) ? a : b;
  double last = a;
  for (int i = 0; i < 60 && std::abs(b - a) > tolerance; ++i) {
    const double c = (fa * b - fb * a) / (fa - fb);
    const double fc = f(c);
    if (std::abs(c - last) < tolerance) return c;
    last = c;
    if (fc * fb < 0) {
      a = b;
      fa = fb;
    } else {
      fa /= 2;
    }
    b = c;
    fb = fc;
    if (fc == 0) break;
  }
  return b;
}

}  // namespace palpa::anatomy
