#include "apps/assess/statistics/bootstrap.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

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

void draw(const Samples& samples, RandomStream& random, Samples& drawn) {
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (double& value : drawn[s])
      value = samples[s][static_cast<std::size_t>(random.openUniform() *
                                                  static_cast<double>(samples[s].size()))];
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
  double squares = 0, cubes = 0;
  for (const double v : influences) {
    squares += v * v;
    cubes += v * v * v;
  }
  return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0;
}

}  // namespace

BootstrapInterval bootstrap(const Samples& samples,
                            const std::function<double(const Samples&)>& figure,
                            const BootstrapSettings& settings) {
  require(samples, settings);
  RandomStream random = RandomStream::ofSeed(settings.seed);
  BootstrapInterval interval{figure(samples), 0, 0};
  std::vector<double> figures(static_cast<std::size_t>(settings.draws));
  Samples drawn = samples;
  double below = 0;
  for (double& f : figures) {
    draw(samples, random, drawn);
    f = figure(drawn);
    below += f < interval.value ? 1 : f == interval.value ? 0.5 : 0;
  }
  if (std::all_of(figures.begin(), figures.end(), [&](double f) { return f == interval.value; }))
    return {interval.value, interval.value, interval.value};

  const boost::math::normal normal;
  const double draws = settings.draws,
               share = std::clamp(below / draws, 0.5 / draws, 1 - 0.5 / draws);
  const double bias = boost::math::quantile(normal, share),
               acceleration = accelerationOf(samples, figure);
  const auto end = [&](double tail) {
    const double z = bias + boost::math::quantile(normal, tail);
    return interpolatedQuantile(
        figures, boost::math::cdf(normal, bias + z / std::max(1e-3, 1 - acceleration * z)));
  };
  interval.low = end((1 - settings.level) / 2);
  interval.high = end((1 + settings.level) / 2);
  return interval;
}

BootstrapInterval bootstrapMean(const std::vector<double>& values,
                                const BootstrapSettings& settings) {
  return bootstrap(
      {values}, [](const Samples& s) { return meanOf(s[0]); }, settings);
}

}  // namespace palpa::statistics
