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
Packed3 corrected(const WorkspaceCorrection& correction, const Packed3& p) noexcept;

}  // namespace palpa::haptics
