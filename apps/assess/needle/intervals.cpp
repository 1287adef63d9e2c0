#include "apps/assess/needle/intervals.h"

#include <algorithm>

namespace palpa::assess {
namespace {

double endOf(Samples samples, std::size_t i) {
  return samples[std::min(i + 1, samples.size() - 1)].t_s;
}

}  // namespace

std::vector<Interval> intervals(Samples samples, const Condition& holds, double bridge_s) {
  std::vector<Interval> found;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!holds(samples[i])) continue;
    const double from = samples[i].t_s, to = endOf(samples, i);
    if (found.empty() || from > found.back().to_s + bridge_s + 1e-9)
      found.push_back({i, i, from, from, 0});
    found.back().last = i;
    found.back().to_s = to;
    found.back().held_s += to - from;
  }
  return found;
}

double heldTime(const std::vector<Interval>& stretches) {
  double sum = 0;
  for (const Interval& stretch : stretches) sum += stretch.held_s;
  return sum;
}

std::vector<double> startsOf(const std::vector<Interval>& stretches) {
  std::vector<double> starts;
  for (const Interval& stretch : stretches) starts.push_back(stretch.from_s);
  return starts;
}

std::vector<std::size_t> scoringSamples(Samples samples, double rate_Hz) {
  std::vector<std::size_t> chosen;
  if (samples.empty()) return chosen;
  constexpr double kTie = 1e-9;  // s: a sample at 0.05 may be written as 0.05000000000000001
  std::size_t i = 0;
  for (long k = 0; k / rate_Hz <= samples.back().t_s + kTie; ++k) {
    while (i + 1 < samples.size() && samples[i + 1].t_s <= k / rate_Hz + kTie) ++i;
    if (samples[i].t_s <= k / rate_Hz + kTie) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace palpa::assess
