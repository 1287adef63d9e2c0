#pragma once

#include <map>
#include <optional>

#include "apps/assess/competence/verdict.h"
#include "apps/assess/statistics/raters.h"

namespace palpa::competence {

/// A trial with what raters, by pseudonym, and the simulator said of it.
struct RatedTrial {
  std::map<std::string, Answers> checklist, global;  ///< by rater
  std::vector<MarkedItem> simulator;
  std::optional<double> total;  ///< penalty of the score; lower is better
};

/// Two who judged the same items of the same trials.
struct PairAgreement {
  std::string one, other;  ///< raters, or "simulator"
  int items = 0;           ///< judged by both, over all trials
  double alike = 0;        ///< share
  double kappa = 0;  ///< Cohen's, unweighted; not a number where both always said one and the same
};

struct Agreement {
  std::vector<PairAgreement> checklist;
  std::vector<std::string> raters;                   ///< of the global rating, who are in the ICC
  int trials = 0;                                    ///< rated by all of them
  std::optional<statistics::RaterAgreement> global;  ///< of the means of the global rating
  int scored = 0;
  /// Spearman's correlation of the raters' mean global rating with the total; negative is what is
  /// hoped for
  std::optional<double> with_total;
  std::vector<std::string> missing;  ///< what could not be computed, and why
};

/// Agreement of raters with each other and with the simulator. Kappa over items, ICC over trials.
Agreement agreementOf(const std::vector<RatedTrial>& trials);

}  // namespace palpa::competence
