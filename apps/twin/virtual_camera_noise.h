#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpa::twin::picture {

/// Counter-based random numbers: the SplitMix64 finaliser (Steele, Lea, Flood 2014) of stream and
/// counter. No state, so any order of drawing gives the same numbers.
std::uint64_t randomBits(std::uint64_t stream, std::uint64_t counter);

/// In [0, 1), 53 bits.
double uniform(std::uint64_t stream, std::uint64_t counter);

/// `count` samples of nearly Gaussian noise (the sum of eight bytes: kurtosis 2.85, nothing
/// beyond 4.9 sigma) of standard deviation `sigma`, rounded to whole numbers. Integers only: the
/// same bits on every processor.
std::vector<std::int16_t> noiseBank(std::uint64_t stream, double sigma, std::size_t count);

}  // namespace palpa::twin::picture
