#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

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

namespace palpa::runtime {

/// Counter-based random numbers: one stream per (seed, component), so that one component's draws
/// never shift another's. SplitMix64 (Steele, Lea, Flood 2014) over a hashed key; the same on every
/// machine.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view component)
      : key_(mix(seed ^ hash(component))) {}

  std::uint64_t bits() { return mix(key_ + 0x9e3779b97f4a7c15ull * ++counter_); }
  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  double normal(double mean, double sd) { return mean + sd * normal(); }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  static std::uint64_t hash(std::string_view text) {  // FNV-1a
    std::uint64_t h = 0xcbf29ce484222325ull;
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return h;
  }
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace palpa::runtime
