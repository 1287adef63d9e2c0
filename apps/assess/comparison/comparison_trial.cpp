#include "apps/assess/comparison/comparison_trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/base/pinned_math.h"

namespace palpa::assess {

const char* moreOf(ComparedProperty property) {
  return property == ComparedProperty::stiffness ? "harder" : "heavier";
}

std::string summaryOf(const ComparisonTrial& trial) {
  if (trial.outcome == training::Outcome::voided) return "Void";
  if (!trial.answered())
    return trial.outcome == training::Outcome::time ? "The time was over before something was said."
                                                    : "Nothing was said.";
  const int more = trial.factors[1] > trial.factors[0] ? 2 : 1;
  const std::string which = more == 1 ? "the first one" : "the second one";
  return std::string(trial.right() ? "Right: " : "Wrong: ") + which + " was " +
         moreOf(trial.property) + ", by " + std::to_string(std::lround(100 * (trial.ratio() - 1))) +
         " %.";
}

std::vector<metrics::MetricValue> comparisonMetrics(const ComparisonTrial& t) {
  return {{"success", t.right() ? 1.0 : 0.0},
          {"time_s", t.seconds},
          {"difference_pct", 100 * (t.ratio() - 1)},
          {"grips", static_cast<double>(t.grips[0] + t.grips[1])},
          {"peak_force_N", t.peak_N}};
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
    if (trial.property != property || !trial.answered()) continue;
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
