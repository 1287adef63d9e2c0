#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace palpa::anatomy {

/// Smooth random field in space: numbers in [-1, 1] on a lattice, blended between (value noise).
/// The same with every compiler and library; neighbours a few cells apart know nothing of each
/// other.
class ValueNoise {
 public:
  ValueNoise(std::uint64_t seed, double cell)
      : seed_(static_cast<std::uint32_t>(seed ^ (seed >> 32))),
        scale_(static_cast<float>(1 / cell)) {}

  float operator()(const std::array<float, 3>& p) const {
    std::array<std::int32_t, 3> at;
    std::array<float, 3> w;
    for (std::size_t k = 0; k < 3; ++k) {
      const float x = p[k] * scale_, low = std::floor(x), t = x - low;
      at[k] = static_cast<std::int32_t>(low);
      w[k] = t * t * (3 - 2 * t);
    }
    const float near = plane(at[0], at[1], at[2], w), far = plane(at[0], at[1], at[2] + 1, w);
    return near + w[2] * (far - near);
  }

 private:
  float plane(std::int32_t x, std::int32_t y, std::int32_t z, const std::array<float, 3>& w) const {
    const float a = at(x, y, z), b = at(x + 1, y, z), c = at(x, y + 1, z), d = at(x + 1, y + 1, z);
    const float low = a + w[0] * (b - a), high = c + w[0] * (d - c);
    return low + w[1] * (high - low);
  }
  float at(std::int32_t x, std::int32_t y, std::int32_t z) const {
    std::uint32_t h = seed_ + 0x9e3779b1u * static_cast<std::uint32_t>(x) +
                      0x85ebca77u * static_cast<std::uint32_t>(y) +
                      0xc2b2ae3du * static_cast<std::uint32_t>(z);
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    h ^= h >> 15;
    return static_cast<float>(h) * 0x1p-31f - 1;
  }

  std::uint32_t seed_;
  float scale_;
};

}  // namespace palpa::anatomy
