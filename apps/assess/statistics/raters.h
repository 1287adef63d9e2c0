#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpa::statistics {

/// Share of the spread of scores that is the subjects' own, with its 95 % interval.
struct Icc {
  double value = 0, low = 0, high = 0;
};

/// How far raters agree on numbers; subjects x raters, no gap. Names after Shrout and Fleiss,
/// Psychol. Bull. 86, 1979; intervals after McGraw and Wong 1996.
struct RaterAgreement {
  Icc one_way;  ///< ICC(1,1): each subject had raters of its own
  /// ICC(2,1): the same raters, drawn from many; a strict rater counts as disagreement
  Icc agreement;
  Icc consistency;  ///< ICC(3,1): the same raters, these only; a strict rater does not count
  Icc one_way_mean, agreement_mean,
      consistency_mean;  ///< ICC(1,k), (2,k), (3,k): of the raters' mean
};

/// Throws Error for fewer than two subjects or raters, a value that is not finite, and where the
/// subjects do not differ at all.
RaterAgreement raterAgreement(const Eigen::MatrixXd& ratings);

enum class KappaWeights {
  none,      ///< any disagreement counts alike: Cohen 1960
  linear,    ///< by distance
  quadratic  ///< by its square: Cohen 1968
};

/// Agreement of two raters in `categories` ordered categories, numbered from 0, beyond chance: 1 -
/// sum w o / sum w e. 1: alike; 0: as by chance. Not a number where both always gave one and the
/// same category: chance alone explains it. Throws Error for no ratings, ratings of unlike number
/// or outside the categories.
double kappa(const std::vector<int>& one, const std::vector<int>& other, int categories,
             KappaWeights weights = KappaWeights::none);

}  // namespace palpa::statistics
