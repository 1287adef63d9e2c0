#include "apps/report/practice/progress_words.h"

#include <cmath>

#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

/// "12 s to 30 s less", "−3 s to 8 s" where the sign is open.
std::string differenceRange(const progress::Change& c) {
  if (c.verdict == progress::Change::ChangeVerdict::unclear)
    return figureOf(c.metric, c.low) + " to " + figureOf(c.metric, c.high);
  const double one = std::abs(c.low), other = std::abs(c.high);
  return figureOf(c.metric, std::min(one, other)) + " to " +
         figureOf(c.metric, std::max(one, other));
}

}  // namespace

std::string intervalWords(const std::string& metric,
                          const std::optional<std::pair<double, double>>& interval) {
  if (!interval) return "";
  return " (95 % interval " + figureOf(metric, interval->first) + " to " +
         figureOf(metric, interval->second) + ")";
}

std::string changeWords(const progress::Change& c) {
  const std::string means = titleWithin(c.metric) + ", from " + figureOf(c.metric, c.first) +
                            " to " + figureOf(c.metric, c.last) +
                            " (means of the first and the last " + std::to_string(c.each) +
                            " trials)";
  if (c.verdict == progress::Change::ChangeVerdict::unclear)
    return means + "; the difference's 95 % interval is " + differenceRange(c);
  return means + ", " + figureOf(c.metric, std::abs(c.difference)) +
         (c.difference < 0 ? " less" : " more") + " (95 % interval " + differenceRange(c) + ')';
}

}  // namespace palpa::report
