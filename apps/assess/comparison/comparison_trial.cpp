#include "apps/assess/comparison/comparison_trial.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "anatomy/base/enum_names.h"
#include "anatomy/base/pinned_math.h"

namespace palpa::assess {

namespace {

const EnumNames<ComparedProperty>& propertyNames() {
  static const EnumNames<ComparedProperty> kNames{"stiffness", "weight", "friction"};
  return kNames;
}

/// Everyone of n things once.
bool isOrder(const std::vector<int>& order, std::size_t n) {
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (sorted[i] != static_cast<int>(i) + 1) return false;
  return sorted.size() == n;
}

std::string nothingSaid(const ComparisonTrial& trial) {
  return trial.outcome == training::Outcome::time ? "The time was over before something was said."
                                                  : "Nothing was said.";
}

std::string sortingSummary(const ComparisonTrial& trial) {
  const std::string order = orderText(trial.trueOrder());
  if (trial.right()) return "Right: from the smoothest it is " + order + '.';
  char tau[24];
  std::snprintf(tau, sizeof tau, "%.2f", trial.tau().value_or(0));
  return "Wrong: said " + orderText(trial.order) + "; from the smoothest it is " + order +
         " (tau " + tau + ").";
}

}  // namespace

bool ComparisonTrial::answered() const {
  if (outcome != training::Outcome::done) return false;
  return sorting() ? isOrder(order, factors.size()) : said == 1 || said == 2;
}

bool ComparisonTrial::right() const {
  if (!answered()) return false;
  return sorting() ? order == trueOrder() : (said == 2) == (factors[1] > factors[0]);
}

double ComparisonTrial::ratio() const {
  return factors[1] > factors[0] ? factors[1] / factors[0] : factors[0] / factors[1];
}

std::vector<int> ComparisonTrial::trueOrder() const {
  std::vector<int> numbers(factors.size());
  std::iota(numbers.begin(), numbers.end(), 1);
  std::stable_sort(numbers.begin(), numbers.end(), [this](int a, int b) {
    return factors[static_cast<std::size_t>(a - 1)] < factors[static_cast<std::size_t>(b - 1)];
  });
  return numbers;
}

std::optional<double> ComparisonTrial::tau() const {
  if (!sorting() || !answered()) return std::nullopt;
  int sum = 0, pairs = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j, ++pairs) {
      const double before = factors[static_cast<std::size_t>(order[i] - 1)],
                   after = factors[static_cast<std::size_t>(order[j] - 1)];
      sum += before < after ? 1 : before > after ? -1 : 0;
    }
  return static_cast<double>(sum) / pairs;
}

const char* moreOf(ComparedProperty property) {
  switch (property) {
    case ComparedProperty::stiffness:
      return "harder";
    case ComparedProperty::weight:
      return "heavier";
    case ComparedProperty::friction:
      break;
  }
  return "rougher";
}

const std::string& nameOf(ComparedProperty property) { return propertyNames().of(property); }

std::optional<ComparedProperty> propertyNamed(std::string_view name) {
  return propertyNames().named(name);
}

std::string orderText(const std::vector<int>& order) {
  std::string text;
  for (const int number : order) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

std::string summaryOf(const ComparisonTrial& trial) {
  if (trial.outcome == training::Outcome::voided) return "Void";
  if (!trial.answered()) return nothingSaid(trial);
  if (trial.sorting()) return sortingSummary(trial);
  const int more = trial.factors[1] > trial.factors[0] ? 2 : 1;
  const std::string which = more == 1 ? "the first one" : "the second one";
  return std::string(trial.right() ? "Right: " : "Wrong: ") + which + " was " +
         moreOf(trial.property) + ", by " + std::to_string(std::lround(100 * (trial.ratio() - 1))) +
         " %.";
}

std::vector<metrics::MetricValue> comparisonMetrics(const ComparisonTrial& t) {
  std::vector<metrics::MetricValue> all{{"success", t.right() ? 1.0 : 0.0}, {"time_s", t.seconds}};
  if (!t.sorting()) all.push_back({"difference_pct", 100 * (t.ratio() - 1)});
  if (const std::optional<double> tau = t.tau()) all.push_back({"order_tau", *tau});
  all.push_back({t.property == ComparedProperty::friction ? "touches" : "grips",
                 static_cast<double>(std::accumulate(t.touches.begin(), t.touches.end(), 0))});
  all.push_back({"peak_force_N", t.peak_N});
  return all;
}

namespace {

constexpr int kFewestAnswers = 8;
constexpr double kLeastSd = 0.005,
                 kMostSd = 5;  // of ln: from what nobody tells to what nobody misses
constexpr int kSteps = 600;
constexpr double kWilks = 1.9207;  // half of chi-squared's 95 % for one parameter

double phi(double z) { return 0.5 * pinned::erfc(-z / std::numbers::sqrt2); }

double sdAt(int step) {
  return kLeastSd * pinned::pow(kMostSd / kLeastSd, static_cast<double>(step) / kSteps);
}

double likelihood(const std::vector<SharesAtRatio>& shares, double sd) {
  double sum = 0;
  for (const SharesAtRatio& share : shares) {
    const double p =
        std::clamp(phi(pinned::log(share.ratio) / (std::numbers::sqrt2 * sd)), 1e-12, 1 - 1e-12);
    sum += share.right * pinned::log(p) + (share.of - share.right) * pinned::log(1 - p);
  }
  return sum;
}

double ratio75(double sd) { return pinned::exp(0.67449 * std::numbers::sqrt2 * sd); }

std::optional<Threshold> thresholdOf(const Discrimination& answers) {
  if (answers.of < kFewestAnswers || answers.right == answers.of) return std::nullopt;
  int best = 0;
  double most = -1e300;
  for (int i = 0; i <= kSteps; ++i)
    if (const double l = likelihood(answers.shares, sdAt(i)); l > most) most = l, best = i;
  if (best == kSteps) return std::nullopt;
  Threshold threshold{ratio75(sdAt(best)), {}, {}};
  const auto refused = [&](int i) { return likelihood(answers.shares, sdAt(i)) < most - kWilks; };
  for (int i = best; i >= 0 && !threshold.low; --i)
    if (refused(i)) threshold.low = ratio75(sdAt(i));
  for (int i = best; i <= kSteps && !threshold.high; ++i)
    if (refused(i)) threshold.high = ratio75(sdAt(i));
  return threshold;
}

}  // namespace

Discrimination discriminationIn(const std::vector<ComparisonTrial>& trials,
                                ComparedProperty property) {
  constexpr double kSame = 1e-3;  // a third more, or two thirds of it: files round
  Discrimination all;
  for (const ComparisonTrial& trial : trials) {
    if (trial.property != property || trial.sorting() || !trial.answered()) continue;
    const auto at = std::find_if(
        all.shares.begin(), all.shares.end(),
        [&](const SharesAtRatio& share) { return std::abs(share.ratio - trial.ratio()) < kSame; });
    SharesAtRatio& share =
        at != all.shares.end() ? *at : all.shares.emplace_back(SharesAtRatio{trial.ratio(), 0, 0});
    share.right += trial.right();
    ++share.of;
    all.right += trial.right();
    ++all.of;
  }
  std::sort(all.shares.begin(), all.shares.end(),
            [](const SharesAtRatio& a, const SharesAtRatio& b) { return a.ratio < b.ratio; });
  all.threshold = thresholdOf(all);
  return all;
}

}  // namespace palpa::assess
