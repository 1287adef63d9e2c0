#pragma once

#include <optional>
#include <string>
#include <utility>

#include "apps/assess/progress/learning_curve.h"

/// Figures of practice in words.
namespace palpa::report {

/// "time", "total penalty": a metric's title within a sentence.
std::string titleWithin(const std::string& metric);
/// "21.5 s", "80 %", "340 points": a mean of a metric with its unit; a metric that is 1 or 0 is a
/// share.
std::string figureOf(const std::string& metric, double mean);
/// The factor and unit in which a metric is drawn: a metric that is 1 or 0 in per cent.
std::pair<double, std::string> scaleOf(const std::string& metric);

/// The figure of one trial for a table, without its unit: "21.5"; a metric that is 1 or 0: "yes",
/// "no".
std::string fieldOf(const std::string& metric, double value);

/// " (95 % interval 12.1 s to 30 s)"; empty without one.
std::string intervalWords(const std::string& metric,
                          const std::optional<std::pair<double, double>>& interval);

/// "time, from 42 s to 21 s (means of the first and the last 5 trials), 21 s less (95 % interval 12
/// s to 30 s)"; where it is unclear the interval has its sign.
std::string changeWords(const progress::Change& change);

}  // namespace palpa::report
