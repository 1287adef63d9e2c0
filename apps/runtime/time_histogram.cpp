#include "apps/runtime/time_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpa::runtime {

int TimeHistogram::binOf(std::int64_t t_ns) noexcept {
  const auto t = static_cast<std::uint64_t>(
      std::clamp<std::int64_t>(t_ns, 0, (std::int64_t{1} << kLongest) - 1));
  const int octave = std::max(static_cast<int>(std::bit_width(t)) - kFine, 0);
  return octave * (1 << (kFine - 1)) + static_cast<int>(t >> octave);
}

double TimeHistogram::middleOf(int bin) noexcept {
  constexpr int kHalf = 1 << (kFine - 1);
  if (bin < 2 * kHalf) return bin;
  const int octave = bin / kHalf - 1;
  const auto low = static_cast<std::int64_t>(bin - octave * kHalf) << octave;
  return static_cast<double>(low) + 0.5 * static_cast<double>((std::int64_t{1} << octave) - 1);
}

void TimeHistogram::add(std::int64_t t_ns) noexcept {
  ++bins_[static_cast<std::size_t>(binOf(t_ns))];
  ++count_;
  max_ns_ = std::max(max_ns_, t_ns);
}

void TimeHistogram::add(const TimeHistogram& other) noexcept {
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
  max_ns_ = std::max(max_ns_, other.max_ns_);
}

double TimeHistogram::quantile(double q) const noexcept {
  const auto rank = static_cast<std::uint64_t>(
      std::clamp(std::ceil(q * static_cast<double>(count_)), 1.0,
                 static_cast<double>(std::max<std::uint64_t>(count_, 1))));
  std::uint64_t up_to = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i)
    if ((up_to += bins_[i]) >= rank)
      return std::min(middleOf(static_cast<int>(i)), static_cast<double>(max_ns_));
  return 0;
}

Spread spreadOf(const TimeHistogram& h) noexcept {
  return {1e-3 * h.quantile(0.5), 1e-3 * h.quantile(0.99), 1e-3 * h.quantile(0.999),
          1e-3 * static_cast<double>(h.max_ns())};
}

}  // namespace palpa::runtime
