#pragma once

#include <array>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

/// A device's systematic position error, taken off: where it says that its end effector is at p,
/// that is at
///   p + sum over k of c_k phi_k(q),   q = (p - centre) / half,
/// phi: the monomials of q up to `order`, by degree, then by falling powers of x, then of y. Order
/// 0 without coefficients: nothing is taken off. All in D, metres.
struct WorkspaceCorrection {
  static constexpr int kHighestOrder = 3;
  static constexpr std::size_t kTerms = 20;  ///< of the highest order
  int order = 0;
  Packed3 centre{0, 0, 0}, half{1, 1, 1};
  std::array<Packed3, kTerms> coefficients{};
};

/// For the haptic tick: allocates nothing, throws nothing.
inline Packed3 corrected(const WorkspaceCorrection& correction, const Packed3& p) noexcept {
  constexpr std::size_t kPowers = WorkspaceCorrection::kHighestOrder + 1;
  std::array<std::array<double, kPowers>, 3> power{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double q = (p[axis] - correction.centre[axis]) / correction.half[axis];
    power[axis][0] = 1;
    for (std::size_t n = 1; n < kPowers; ++n) power[axis][n] = power[axis][n - 1] * q;
  }
  Packed3 result = p;
  std::size_t term = 0;
  for (int degree = 0; degree <= correction.order; ++degree)
    for (int i = degree; i >= 0; --i)
      for (int j = degree - i; j >= 0; --j, ++term) {
        const double phi = power[0][static_cast<std::size_t>(i)] *
                           power[1][static_cast<std::size_t>(j)] *
                           power[2][static_cast<std::size_t>(degree - i - j)];
        for (std::size_t axis = 0; axis < 3; ++axis)
          result[axis] += correction.coefficients[term][axis] * phi;
      }
  return result;
}

}  // namespace palpa::haptics
