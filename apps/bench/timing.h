#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace palpa::bench {

/// Two things measured in turn, so that a machine that warms up or slows down meets both alike.
enum class Turn { a, b };

/// A B B A, `blocks` times: within a block a steady drift adds the same to both.
std::vector<Turn> abbaOrder(int blocks);

struct ConfidenceInterval {
  double low = 0, high = 0;
};
/// 95 % interval of the median by the percentile bootstrap (Efron 1979): `resamples` times as many
/// draws with replacement as there are values; the 2.5 % and 97.5 % quantiles of their medians.
/// Same seed, same interval; NaN for no values.
ConfidenceInterval bootstrapMedian(const std::vector<double>& values, int resamples,
                                   std::uint64_t seed);

struct QueryTiming {
  double median_us = 0, p99_us = 0;
};

/// `ask(i)` for i = 0 .. count - 1, as fast as it goes, 16 timed at a time.
QueryTiming timeQueries(int count, const std::function<void(int)>& ask);
/// Each timed alone, after 32 MiB of other memory has been read: nothing of the mesh is in a cache.
QueryTiming timeCold(int count, const std::function<void(int)>& ask);

struct Ratio {
  double median = 0;
  ConfidenceInterval interval;
};
/// How many times as long b takes as a over the same queries: A B B A in turn, a ratio of times a
/// block, their median.
Ratio compareQueries(int blocks, int count, const std::function<void(int)>& a,
                     const std::function<void(int)>& b);

/// One line of JSON: {"metric": ..., "value": ..., "unit": ..., "params": {...}}.
void print(const std::string& metric, double value, const std::string& unit,
           const nlohmann::json& params);

}  // namespace palpa::bench
