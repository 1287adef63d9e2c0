#include "haptics/loop/workspace_correction.h"

namespace palpa::haptics {

Packed3 corrected(const WorkspaceCorrection& correction, const Packed3& p) noexcept {
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
