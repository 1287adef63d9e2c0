#pragma once

#include <type_traits>

namespace palpa::haptics {

/// Normal force of a soft thing against how deep it is pressed (Hunt & Crossley 1975): x depth, m,
/// along the inward normal; x' its rate, m/s.
///     f = x^m max(k + b x', k / 10)        k in N/m^m, b in N s/m^(m+1); 1 <= m <= 2 for surfaces
/// The bound keeps a thing that is left fast from pulling, and makes the law invertible. No force
/// at x <= 0.
struct HuntCrossley {
  double k = 0, b = 0, m = 1;
};
static_assert(std::is_trivially_copyable_v<HuntCrossley>);

double forceOf(const HuntCrossley& law, double x, double rate) noexcept;  ///< N
double depthOf(const HuntCrossley& law, double f,
               double rate) noexcept;  ///< m; the inverse: x of forceOf(x) = f; 0 for f <= 0
double stiffnessOf(const HuntCrossley& law, double x, double rate) noexcept;  ///< df/dx, N/m

}  // namespace palpa::haptics
