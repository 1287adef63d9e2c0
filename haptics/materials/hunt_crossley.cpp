#include "haptics/materials/hunt_crossley.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

/// What multiplies x^m.
double factorOf(const HuntCrossley& law, double rate) noexcept {
  return std::max(law.k + law.b * rate, 0.1 * law.k);
}

}  // namespace

double forceOf(const HuntCrossley& law, double x, double rate) noexcept {
  return x > 0 ? std::pow(x, law.m) * factorOf(law, rate) : 0;
}

double depthOf(const HuntCrossley& law, double f, double rate) noexcept {
  const double factor = factorOf(law, rate);
  return f > 0 && factor > 0 ? std::pow(f / factor, 1 / law.m) : 0;
}

double stiffnessOf(const HuntCrossley& law, double x, double rate) noexcept {
  return x > 0 ? law.m * std::pow(x, law.m - 1) * factorOf(law, rate) : 0;
}

}  // namespace palpa::haptics
