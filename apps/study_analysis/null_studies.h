#pragma once

#include <cstdint>
#include <vector>

#include "apps/study_analysis/learning_model.h"

namespace palpa::study_analysis {

/// How often an analysis called something an effect, by the very tests of the page.
struct Detections {
  int studies = 0;
  int groups = 0,
      learning = 0;  ///< one value a subject, two-sided: Welch between groups, paired within
  int groups_published = 0,
      learning_published = 0;  ///< trials pooled, one-tailed: experienced people have smaller
                               ///< figures, figures fall with practice
};

struct DrawnStudies {
  int studies = 2000;
  int subjects = 5;  ///< in each group and condition: 20 in all, as in the paper
  int trials = 10;
  double level = 0.05;  ///< of each test
  std::uint64_t seed = 1;
};

/// Draws studies from one model alone and tests each at its last condition (with force feedback):
/// second group against first over all trials, last two against first two trials of the first
/// group. With nullModels() these are false positives, with pilotModels() the power.
Detections detectionsIn(const LearningModel& model, const DrawnStudies& drawn);

/// Counts that 95 of 100 fair tests stay within: the 2.5 % and 97.5 % points of the binomial
/// distribution.
struct Band {
  int low = 0, high = 0;
};
Band binomialBand(int studies, double level);

}  // namespace palpa::study_analysis
