#include "apps/assess/statistics/cusum.h"

#include <cmath>

#include "anatomy/base/error.h"

namespace palpa::statistics {

CusumLimits cusumLimits(const CusumRates& r) {
  const auto share = [](double v) { return v > 0 && v < 1; };
  if (!share(r.acceptable) || !share(r.unacceptable) || !(r.acceptable < r.unacceptable) ||
      !(r.alpha > 0 && r.alpha < 0.5) || !(r.beta > 0 && r.beta < 0.5))
    throw UsageError(
        "rates must be 0 < acceptable < unacceptable < 1, chances of error below a half", "CUSUM",
        "10 % and 25 % with 0.1 each are an example");
  const double p = std::log(r.unacceptable / r.acceptable),
               q = std::log((1 - r.acceptable) / (1 - r.unacceptable));
  CusumLimits limits{q / (p + q), std::log((1 - r.alpha) / r.beta) / (p + q),
                     std::log((1 - r.beta) / r.alpha) / (p + q), 0};
  limits.shortest_clean_run = static_cast<int>(std::ceil(limits.h_accept / limits.s));
  return limits;
}

Cusum cusum(const std::vector<bool>& failures, const CusumLimits& limits) {
  Cusum chart;
  double sum = 0;
  for (const bool failed : failures) {
    if (!chart.verdicts.empty() && chart.verdicts.back() != CusumVerdict::undecided) sum = 0;
    sum += failed ? 1 - limits.s : -limits.s;
    CusumVerdict verdict = CusumVerdict::undecided;
    if (sum <= -limits.h_accept) verdict = CusumVerdict::acceptable;
    if (sum >= limits.h_reject) verdict = CusumVerdict::unacceptable;
    if (verdict != CusumVerdict::undecided) chart.last = verdict;
    chart.sums.push_back(sum);
    chart.verdicts.push_back(verdict);
  }
  return chart;
}

}  // namespace palpa::statistics
