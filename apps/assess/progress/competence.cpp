#include "apps/assess/progress/competence.h"

#include <cmath>

namespace palpa::progress {

using statistics::CusumVerdict;

Competence competenceOf(const std::vector<bool>& failures, const statistics::CusumRates& rates) {
  Competence c;
  c.rates = rates;
  c.limits = statistics::cusumLimits(rates);
  c.chart = statistics::cusum(failures, c.limits);
  c.minimum = static_cast<std::size_t>(c.limits.shortest_clean_run);
  for (std::size_t i = 0; i < c.chart.verdicts.size(); ++i) {
    const CusumVerdict verdict = c.chart.verdicts[i];
    if (verdict == CusumVerdict::unacceptable) {
      c.reached.reset();
      c.lost = i + 1;
    }
    if (verdict == CusumVerdict::acceptable) {
      if (!c.reached) c.reached = i + 1;
      c.lost.reset();
    }
  }
  if (c.reached) return c;
  const bool anew = c.chart.sums.empty() || c.chart.verdicts.back() != CusumVerdict::undecided;
  const double sum = anew ? 0 : c.chart.sums.back();
  c.still_clean =
      static_cast<std::size_t>(std::ceil((sum + c.limits.h_accept) / c.limits.s - 1e-9));
  return c;
}

}  // namespace palpa::progress
