#include "apps/assess/statistics/bootstrap.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::statistics {
namespace {

constexpr char kBootstrap[] = "bootstrap";

void require(const Samples& samples, const BootstrapSettings& settings) {
  if (samples.empty()) throw Error("there is no sample", kBootstrap, "Collect more trials");
  for (const std::vector<double>& sample : samples)
    if (sample.empty()) throw Error("a sample has no values", kBootstrap, "Collect more trials");
  if (settings.draws < 200 || !(settings.level > 0 && settings.level < 1))
    throw Error("needs 200 draws or more and a level between 0 and 1", kBootstrap,
                "Check the settings");
}

std::size_t drawnFrom(std::size_t size, RandomStream& random) {
  // by way of a signed number, to which the processor converts at once
  return static_cast<std::size_t>(
      static_cast<std::int64_t>(random.openUniform() * static_cast<double>(size)));
}

void draw(const Samples& samples, RandomStream& random, Samples& drawn) {
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (double& value : drawn[s]) value = samples[s][drawnFrom(samples[s].size(), random)];
}

/// Skewness of influences over 6.
double accelerationBy(const std::vector<double>& influences) {
  double squares = 0, cubes = 0;
  for (const double v : influences) {
    squares += v * v;
    cubes += v * v * v;
  }
  return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0;
}

/// Skewness of the figure's jackknife values over 6: how its spread changes with it.
double accelerationOf(const Samples& samples, const std::function<double(const Samples&)>& figure) {
  std::vector<double> influences;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (samples[s].size() < 2) continue;
    std::vector<double> left;
    for (std::size_t i = 0; i < samples[s].size(); ++i) {
      Samples without = samples;
      without[s].erase(without[s].begin() + static_cast<std::ptrdiff_t>(i));
      left.push_back(figure(without));
    }
    const double mean = meanOf(left), n = static_cast<double>(left.size());
    for (const double v : left) influences.push_back((mean - v) * (n - 1) / n);
  }
  return accelerationBy(influences);
}

/// The corrected interval, from the drawn figures; `acceleration` is asked for only where they
/// differ.
BootstrapInterval intervalOf(double value, const std::vector<double>& figures, double level,
                             const std::function<double()>& acceleration) {
  double below = 0;
  bool same = true;
  for (const double f : figures) {
    below += f < value ? 1 : f == value ? 0.5 : 0;
    same = same && f == value;
  }
  if (same) return {value, value, value};
  static const boost::math::normal normal;
  const double draws = static_cast<double>(figures.size()),
               share = std::clamp(below / draws, 0.5 / draws, 1 - 0.5 / draws);
  const double bias = boost::math::quantile(normal, share), curved = acceleration();
  const auto end = [&](double tail) {
    const double z = bias + boost::math::quantile(normal, tail);
    return interpolatedQuantile(
        figures, boost::math::cdf(normal, bias + z / std::max(1e-3, 1 - curved * z)));
  };
  return {value, end((1 - level) / 2), end((1 + level) / 2)};
}

}  // namespace

BootstrapInterval bootstrap(const Samples& samples,
                            const std::function<double(const Samples&)>& figure,
                            const BootstrapSettings& settings) {
  require(samples, settings);
  RandomStream random = RandomStream::ofSeed(settings.seed);
  std::vector<double> figures(static_cast<std::size_t>(settings.draws));
  Samples drawn = samples;
  for (double& f : figures) {
    draw(samples, random, drawn);
    f = figure(drawn);
  }
  return intervalOf(figure(samples), figures, settings.level,
                    [&] { return accelerationOf(samples, figure); });
}

namespace {

/// So many samples are drawn together that their sums stay in the processor's registers.
constexpr std::size_t kMostTogether = 16, kFewTogether = 4;

/// A mean's jackknife value without v differs from the others' mean by (v - mean) / (n - 1).
double accelerationOfMean(const std::vector<double>& values, double mean) {
  std::vector<double> influences;
  if (values.size() > 1)
    for (const double v : values)
      influences.push_back((v - mean) / static_cast<double>(values.size()));
  return accelerationBy(influences);
}

/// Means of all draws of up to `Width` samples of one size, sample by sample. Their values lie side
/// by side, so that one look-up serves all; each sum has the order that it has alone.
template <std::size_t Width>
Samples drawnMeans(const std::vector<const std::vector<double>*>& samples,
                   const BootstrapSettings& settings) {
  using Lanes = std::array<double, Width>;
  const std::size_t size = samples[0]->size();
  std::vector<Lanes> beside(size, Lanes{});
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (std::size_t i = 0; i < size; ++i) beside[i][s] = (*samples[s])[i];
  RandomStream random = RandomStream::ofSeed(settings.seed);
  const auto draws = static_cast<std::size_t>(settings.draws);
  Samples means(samples.size(), std::vector<double>(draws));
  for (std::size_t d = 0; d < draws; ++d) {
    Lanes sums{};
    for (std::size_t i = 0; i < size; ++i) {
      const Lanes& row = beside[drawnFrom(size, random)];
      for (std::size_t s = 0; s < Width; ++s) sums[s] += row[s];
    }
    for (std::size_t s = 0; s < samples.size(); ++s)
      means[s][d] = sums[s] / static_cast<double>(size);
  }
  return means;
}

/// Of up to 16 samples of one size.
std::vector<BootstrapInterval> intervalsOf(const std::vector<const std::vector<double>*>& samples,
                                           const BootstrapSettings& settings) {
  const Samples means = samples.size() > kFewTogether ? drawnMeans<kMostTogether>(samples, settings)
                                                      : drawnMeans<kFewTogether>(samples, settings);
  std::vector<BootstrapInterval> intervals;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const double mean = meanOf(*samples[s]);
    intervals.push_back(intervalOf(mean, means[s], settings.level,
                                   [&] { return accelerationOfMean(*samples[s], mean); }));
  }
  return intervals;
}

}  // namespace

std::vector<BootstrapInterval> bootstrapMeans(const Samples& samples,
                                              const BootstrapSettings& settings) {
  if (samples.empty()) return {};
  require(samples, settings);
  std::map<std::size_t, std::vector<std::size_t>> by_size;
  for (std::size_t s = 0; s < samples.size(); ++s) by_size[samples[s].size()].push_back(s);
  std::vector<BootstrapInterval> all(samples.size());
  for (const auto& [size, places] : by_size)
    for (std::size_t from = 0; from < places.size(); from += kMostTogether) {
      std::vector<const std::vector<double>*> together;
      for (std::size_t i = from; i < std::min(places.size(), from + kMostTogether); ++i)
        together.push_back(&samples[places[i]]);
      const std::vector<BootstrapInterval> theirs = intervalsOf(together, settings);
      for (std::size_t i = 0; i < theirs.size(); ++i) all[places[from + i]] = theirs[i];
    }
  return all;
}

}  // namespace palpa::statistics
