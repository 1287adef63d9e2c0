#include "haptics/materials/needle_materials.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {
constexpr double kLargestExponent = 40;  // keeps absurd indentations finite
}

double SkinLaw::force(double u) const {
  if (u <= 0) return 0;
  const double exponent = std::min(m * (u - u_0), kLargestExponent);
  return u > u_0 ? (K_0 * (std::exp(exponent) - 1) + K_min) * u : K_min * u;
}

double SkinLaw::stiffness(double u) const {
  if (u <= u_0) return u > 0 ? K_min : 0;
  const double grown = std::exp(std::min(m * (u - u_0), kLargestExponent));
  return K_0 * (grown - 1) + K_min + K_0 * m * grown * u;
}

}  // namespace palpa::haptics
