#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "anatomy/base/pinned_math.h"

namespace palpa {

/// What SplitMix64 (Steele, Lea, Flood 2014) adds to its state for each number.
inline constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15ull;

/// The mixing function of SplitMix64: one to one on 64 bits.
constexpr std::uint64_t mixedBits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// The number that SplitMix64 gives in this state; its next state is `state` + kSplitMixStep.
constexpr std::uint64_t splitMix64(std::uint64_t state) { return mixedBits(state + kSplitMixStep); }

/// Counter-based random numbers: the n-th number is a function of the key and n alone, the same
/// with every compiler, library and machine. There are two recorded sequences, and neither may
/// change, since patients and sessions are drawn again from their seeds:
/// - RandomStream(seed, component), drawn with uniform() and normal(): one stream per component, so
///   that one component's draws never shift another's;
/// - RandomStream::ofSeed(seed), drawn with openUniform() and openNormal(): patients, bootstraps.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view component)
      : RandomStream(Key{mixedBits(seed ^ hash(component))}) {}
  static RandomStream ofSeed(std::uint64_t seed) { return RandomStream(Key{splitMix64(seed)}); }

  std::uint64_t bits() { return splitMix64(key_ + kSplitMixStep * counter_++); }

  double uniform() { return fraction(0); }  ///< in [0, 1), 53 bits
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal() {  ///< standard normal (Box and Muller 1958)
    const double radius = std::sqrt(-2 * pinned::log(1 - uniform()));
    return radius * pinned::cos(2 * std::numbers::pi * uniform());
  }
  double normal(double mean, double sd) { return mean + sd * normal(); }

  double openUniform() { return fraction(0.5); }  ///< in (0, 1)
  double openNormal() {
    const double radius = std::sqrt(-2 * pinned::log(openUniform()));
    return radius * pinned::cos(2 * std::numbers::pi * openUniform());
  }

 private:
  struct Key {
    std::uint64_t bits;
  };
  explicit RandomStream(Key key) : key_(key.bits) {}
  double fraction(double offset) { return (static_cast<double>(bits() >> 11) + offset) * 0x1p-53; }
  static std::uint64_t hash(std::string_view text) {  // FNV-1a
    std::uint64_t h = 0xcbf29ce484222325ull;
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return h;
  }

  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace palpa
