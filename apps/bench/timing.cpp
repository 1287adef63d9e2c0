#include "apps/bench/timing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "anatomy/base/quantile.h"
#include "anatomy/base/random.h"
#include "apps/runtime/clock.h"

namespace palpa::bench {

std::vector<Turn> abbaOrder(int blocks) {
  std::vector<Turn> order;
  for (int i = 0; i < blocks; ++i) order.insert(order.end(), {Turn::a, Turn::b, Turn::b, Turn::a});
  return order;
}

ConfidenceInterval bootstrapMedian(const std::vector<double>& values, int resamples,
                                   std::uint64_t seed) {
  if (values.empty()) return {median({}), median({})};
  RandomStream random(seed, "bench.bootstrap");
  std::vector<double> medians, drawn(values.size());
  for (int i = 0; i < resamples; ++i) {
    for (double& value : drawn)
      value =
          values[static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()))];
    medians.push_back(median(drawn));
  }
  return {quantile(medians, 0.025), quantile(medians, 0.975)};
}

namespace {

constexpr int kTogether = 16;
constexpr int kTimingResamples = 2000;

QueryTiming timingOf(const std::vector<double>& each_us) {
  return {quantile(each_us, 0.5), quantile(each_us, 0.99)};
}

double timeAll(const runtime::SteadyClock& clock, int count, const std::function<void(int)>& ask) {
  const std::int64_t start = clock.now();
  for (int i = 0; i < count; ++i) ask(i);
  return static_cast<double>(clock.now() - start);
}

}  // namespace

QueryTiming timeQueries(int count, const std::function<void(int)>& ask) {
  const runtime::SteadyClock clock;
  for (int i = 0; i < std::min(count, 1000); ++i) ask(i);
  std::vector<double> each;
  for (int i = 0; i + kTogether <= count; i += kTogether) {
    const std::int64_t start = clock.now();
    for (int k = 0; k < kTogether; ++k) ask(i + k);
    each.push_back(1e-3 * static_cast<double>(clock.now() - start) / kTogether);
  }
  return timingOf(each);
}

QueryTiming timeCold(int count, const std::function<void(int)>& ask) {
  const runtime::SteadyClock clock;
  std::vector<std::uint64_t> other((32u << 20) / sizeof(std::uint64_t), 1);
  volatile std::uint64_t sum = 0;
  std::vector<double> each;
  for (int i = 0; i < count; ++i) {
    std::uint64_t read = 0;
    for (std::size_t k = 0; k < other.size(); k += 8) read += other[k] += 1;
    sum = sum + read;
    const std::int64_t start = clock.now();
    ask(i);
    each.push_back(1e-3 * static_cast<double>(clock.now() - start));
  }
  return timingOf(each);
}

Ratio compareQueries(int blocks, int count, const std::function<void(int)>& a,
                     const std::function<void(int)>& b) {
  const runtime::SteadyClock clock;
  timeAll(clock, std::min(count, 500), a);
  timeAll(clock, std::min(count, 500), b);
  std::vector<double> ratios;
  double took_a = 0, took_b = 0;
  int turn = 0;
  for (const Turn whose : abbaOrder(blocks)) {
    (whose == Turn::a ? took_a : took_b) += timeAll(clock, count, whose == Turn::a ? a : b);
    if (++turn % 4) continue;
    ratios.push_back(took_b / took_a);
    took_a = took_b = 0;
  }
  return {median(ratios), bootstrapMedian(ratios, kTimingResamples, 1)};
}

void print(const std::string& metric, double value, const std::string& unit,
           const nlohmann::json& params) {
  nlohmann::ordered_json line;
  line["metric"] = metric;
  if (std::isfinite(value))
    line["value"] = value;
  else
    line["value"] = nullptr;
  line["unit"] = unit;
  line["params"] = params;
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

}  // namespace palpa::bench
