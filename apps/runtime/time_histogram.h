#pragma once

#include <array>
#include <cstdint>

namespace palpa::runtime {

/// Counts of times between 0 and 2^40 ns (18 min), in fixed bins, so that a real-time thread can
/// fill it: 1 ns wide below 256 ns, above that 128 to an octave, so that a quantile is within 0.4 %
/// of its value. Never allocates after construction.
class TimeHistogram {
 public:
  void add(std::int64_t t_ns) noexcept;  ///< below 0 counts as 0
  void add(const TimeHistogram& other) noexcept;

  /// Value in ns that the share q of all, rounded up to a whole count, does not exceed (nearest
  /// rank): the middle of its bin, at most the largest. 0 for none.
  double quantile(double q) const noexcept;
  std::uint64_t count() const noexcept { return count_; }
  std::int64_t max_ns() const noexcept { return max_ns_; }

 private:
  static constexpr int kLongest = 40, kFine = 8;  // bits
  static constexpr int kBins = (1 << kFine) + (kLongest - kFine) * (1 << (kFine - 1));
  static int binOf(std::int64_t t_ns) noexcept;
  static double middleOf(int bin) noexcept;

  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

/// What is said of a histogram, in microseconds.
struct Spread {
  double median_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
};
Spread spreadOf(const TimeHistogram& histogram) noexcept;

}  // namespace palpa::runtime
