#include "apps/assess/palpation/mark_meaning.h"

#include <algorithm>

namespace palpa::assess {

MarkMeaning meaningOf(std::size_t mark, const PalpationRules& rules, const PalpationScore& score,
                      const std::vector<CaseLump>& lumps, const std::vector<LumpMark>& marks) {
  const bool found = std::any_of(
      score.lumps.begin(), score.lumps.end(),
      [&](const LumpVerdict& verdict) { return verdict.mark == static_cast<int>(mark); });
  if (found) return MarkMeaning::found;
  const bool near = std::any_of(lumps.begin(), lumps.end(), [&](const CaseLump& lump) {
    return (lump.p_P - marks[mark].p_P).head<2>().norm() <= rules.found_within;
  });
  return near ? MarkMeaning::repeated : MarkMeaning::false_alarm;
}

}  // namespace palpa::assess
