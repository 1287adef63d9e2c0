#include "apps/assess/statistics/sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/math/distributions/normal.hpp>

#include "anatomy/base/error.h"

namespace palpa::statistics {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void requireFinite(const std::vector<double>& values, const std::string& where) {
  for (const double v : values)
    if (!std::isfinite(v))
      throw Error("a value is not a number", where, "Leave trials without a value out");
}

double sdOf(const std::vector<double>& values, double mean) {
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1));
}

double between(const std::vector<double>& sorted, double q) {
  const double place = q * (static_cast<double>(sorted.size()) - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

double meanOf(const std::vector<double>& values) {
  if (values.empty()) return kNone;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Moments momentsOf(const std::vector<double>& values, const std::string& where) {
  if (values.size() < 2)
    throw Error("there are fewer than two values", where, "Collect more trials");
  requireFinite(values, where);
  const double mean = meanOf(values);
  return {mean, sdOf(values, mean), static_cast<double>(values.size())};
}

double interpolatedQuantile(std::vector<double> values, double q) {
  if (values.empty()) return kNone;
  const double place = std::clamp(q, 0.0, 1.0) * (static_cast<double>(values.size()) - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), below, values.end());
  const double above =
      below + 1 == values.end() ? *below : *std::min_element(below + 1, values.end());
  return *below + (place - std::floor(place)) * (above - *below);
}

Description describe(const std::vector<double>& values) {
  if (values.empty()) return {0, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  requireFinite(values, "description of a sample");
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const double mean = meanOf(values);
  return {values.size(),         mean,
          sdOf(values, mean),    between(sorted, 0.5),
          between(sorted, 0.25), between(sorted, 0.75),
          sorted.front(),        sorted.back()};
}

Ranks ranksOf(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  Ranks ranks{std::vector<double>(values.size()), 0};
  for (std::size_t first = 0, last; first < order.size(); first = last) {
    for (last = first + 1; last < order.size() && values[order[last]] == values[order[first]];)
      ++last;
    const double t = static_cast<double>(last - first),
                 shared = (static_cast<double>(first + last) + 1) / 2;
    for (std::size_t i = first; i < last; ++i) ranks.of[order[i]] = shared;
    ranks.ties += t * t * t - t;
  }
  return ranks;
}

namespace {

double zOf(int called, int of) {
  return boost::math::quantile(boost::math::normal(), (called + 0.5) / (of + 1.0));
}

}  // namespace

Discrimination discriminationOf(const Detections& seen) {
  if (seen.signals <= 0 || seen.rest <= 0) return {};
  const double hits = zOf(seen.hits, seen.signals), alarms = zOf(seen.alarms, seen.rest);
  return {hits - alarms, -(hits + alarms) / 2};
}

}  // namespace palpa::statistics
