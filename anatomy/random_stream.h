#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace palpa::anatomy {

/// Counter-based random numbers: the n-th number of a seed is splitmix64 (Steele, Lea, Flood 2014)
/// of seed and n, the same with every compiler and library.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : seed_(mix(seed + 0x9e3779b97f4a7c15ull)) {}

  double uniform() { return (double(next() >> 11) + 0.5) * 0x1.0p-53; }  ///< in (0, 1)
  double normal() {                                                      ///< Box and Muller 1958
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  std::uint64_t next() { return mix(seed_ + ++count_ * 0x9e3779b97f4a7c15ull); }

  std::uint64_t seed_, count_ = 0;
};

}  // namespace palpa::anatomy
