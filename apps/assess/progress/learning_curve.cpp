#include "apps/assess/progress/learning_curve.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"
#include "anatomy/base/random.h"
#include "apps/assess/statistics/bootstrap.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::progress {
namespace {

constexpr int kConstants = 120, kCurveDraws = 1000;
constexpr std::size_t kFewestForChange = 6;

/// exp(-(n - 1) / c) at the trials, and what least squares needs of it.
struct Basis {
  double c = 1, sum = 0, squares = 0;
  std::vector<double> e;
};

std::vector<Basis> basesFor(const std::vector<double>& n, std::size_t length) {
  const double shortest = 0.5, longest = 3.0 * static_cast<double>(length);
  std::vector<Basis> all;
  for (int i = 0; i < kConstants; ++i) {
    Basis basis;
    basis.c = shortest * pinned::pow(longest / shortest, i / (kConstants - 1.0));
    for (const double trial : n) {
      basis.e.push_back(pinned::exp(-(trial - 1) / basis.c));
      basis.sum += basis.e.back();
      basis.squares += basis.e.back() * basis.e.back();
    }
    all.push_back(std::move(basis));
  }
  return all;
}

struct CurveFit {
  double a = 0, b = 0, c = 1, left = 0;  ///< left: sum of squares about it
  double at(double trial) const { return a + b * pinned::exp(-(trial - 1) / c); }
};

/// a and b for this c, in closed form.
CurveFit fitWith(const Basis& basis, const std::vector<double>& y, double sum, double squares) {
  double product = 0;
  for (std::size_t i = 0; i < y.size(); ++i) product += basis.e[i] * y[i];
  const double n = static_cast<double>(y.size()),
               spread = basis.squares - basis.sum * basis.sum / n;
  const double covariance = product - basis.sum * sum / n;
  const double b = spread > 1e-12 ? covariance / spread : 0;
  return {(sum - b * basis.sum) / n, b, basis.c, squares - sum * sum / n - b * covariance};
}

CurveFit bestFit(const std::vector<Basis>& bases, const std::vector<double>& y) {
  double sum = 0, squares = 0;
  for (const double v : y) {
    sum += v;
    squares += v * v;
  }
  CurveFit best = fitWith(bases.front(), y, sum, squares);
  for (const Basis& basis : bases)
    if (const CurveFit fit = fitWith(basis, y, sum, squares); fit.left < best.left) best = fit;
  return best;
}

/// The curve at every trial, in every draw of the residuals.
std::vector<std::vector<double>> drawnCurves(const std::vector<Basis>& bases, const CurveFit& fit,
                                             const std::vector<double>& n,
                                             const std::vector<double>& y, std::size_t length,
                                             std::uint64_t seed) {
  const double count = static_cast<double>(y.size()), inflate = std::sqrt(count / (count - 3));
  std::vector<double> residuals;
  for (std::size_t i = 0; i < y.size(); ++i) residuals.push_back(inflate * (y[i] - fit.at(n[i])));
  RandomStream random = RandomStream::ofSeed(seed);
  std::vector<std::vector<double>> curves(length + 1);  // the last: the change
  for (int d = 0; d < kCurveDraws; ++d) {
    std::vector<double> drawn;
    for (const double trial : n)
      drawn.push_back(fit.at(trial) +
                      residuals[static_cast<std::size_t>(random.openUniform() * count)]);
    const CurveFit again = bestFit(bases, drawn);
    for (std::size_t i = 0; i < length; ++i)
      curves[i].push_back(again.at(static_cast<double>(i + 1)));
    curves[length].push_back(again.at(static_cast<double>(length)) - again.at(1));
  }
  return curves;
}

}  // namespace

std::optional<LearningCurve> learningCurve(const std::vector<double>& values, std::uint64_t seed) {
  LearningCurve curve;
  std::vector<double> y;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    curve.trials.push_back(static_cast<double>(i + 1));
    y.push_back(values[i]);
  }
  if (y.size() < kFewestForCurve ||
      std::all_of(y.begin(), y.end(), [&](double v) { return v == y.front(); }))
    return std::nullopt;
  const std::vector<Basis> bases = basesFor(curve.trials, values.size());
  const CurveFit fit = bestFit(bases, y);
  curve.asymptote = fit.a;
  curve.gain = fit.b;
  curve.constant = fit.c;
  curve.spread = std::sqrt(std::max(0.0, fit.left) / (static_cast<double>(y.size()) - 3));
  const auto drawn = drawnCurves(bases, fit, curve.trials, y, values.size(), seed);
  for (std::size_t i = 0; i < values.size(); ++i) {
    curve.fitted.push_back(fit.at(static_cast<double>(i + 1)));
    curve.low.push_back(statistics::interpolatedQuantile(drawn[i], 0.025));
    curve.high.push_back(statistics::interpolatedQuantile(drawn[i], 0.975));
  }
  curve.change = curve.fitted.back() - curve.fitted.front();
  curve.change_low = statistics::interpolatedQuantile(drawn.back(), 0.025);
  curve.change_high = statistics::interpolatedQuantile(drawn.back(), 0.975);
  return curve;
}

std::optional<Change> changeOf(const std::string& metric, const std::vector<double>& values) {
  const metrics::MetricDefinition* definition = metrics::metricNamed(metric);
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](double v) { return std::isfinite(v); });
  if (!definition || definition->better == metrics::Better::neither ||
      known.size() < kFewestForChange)
    return std::nullopt;
  Change change{metric, std::clamp<std::size_t>(known.size() / 3, 3, 5),
                0,      0,
                0,      0,
                0,      Change::ChangeVerdict::unclear};
  const auto k = static_cast<std::ptrdiff_t>(change.each);
  const std::vector<double> first(known.begin(), known.begin() + k),
      last(known.end() - k, known.end());
  const statistics::BootstrapInterval interval =
      statistics::bootstrap({first, last}, [](const statistics::Samples& s) {
        return statistics::meanOf(s[1]) - statistics::meanOf(s[0]);
      });
  change.first = statistics::meanOf(first);
  change.last = statistics::meanOf(last);
  change.difference = interval.value;
  change.low = interval.low;
  change.high = interval.high;
  const bool lower = definition->better == metrics::Better::lower;
  if (change.high < 0)
    change.verdict = lower ? Change::ChangeVerdict::better : Change::ChangeVerdict::worse;
  if (change.low > 0)
    change.verdict = lower ? Change::ChangeVerdict::worse : Change::ChangeVerdict::better;
  return change;
}

std::vector<SuccessBlock> successBlocks(const std::vector<bool>& successes, std::size_t size) {
  std::vector<SuccessBlock> blocks;
  for (std::size_t from = 0; from < successes.size();) {
    const std::size_t left = successes.size() - from, length = left < 2 * size ? left : size;
    const auto begin = successes.begin() + static_cast<std::ptrdiff_t>(from);
    const int hits =
        static_cast<int>(std::count(begin, begin + static_cast<std::ptrdiff_t>(length), true));
    blocks.push_back({from + 1, from + length, hits, static_cast<int>(length),
                      statistics::wilson(hits, static_cast<int>(length))});
    from += length;
  }
  return blocks;
}

}  // namespace palpa::progress
