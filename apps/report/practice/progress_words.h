#pragma once

#include <optional>
#include <string>
#include <utility>

#include "apps/assess/progress/learning_curve.h"
#include "apps/report/page/figure_words.h"

/// Figures of practice in words.
namespace palpa::report {

/// " (95 % interval 12.1 s to 30 s)"; empty without one.
std::string intervalWords(const std::string& metric,
                          const std::optional<std::pair<double, double>>& interval);

/// "time, from 42 s to 21 s (means of the first and the last 5 trials), 21 s less (95 % interval 12
/// s to 30 s)"; where it is unclear the interval has its sign.
std::string changeWords(const progress::Change& change);

}  // namespace palpa::report
