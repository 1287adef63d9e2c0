#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/study/analysis/study_row.h"

namespace palpa::study_analysis {

/// How one group does under one condition.
struct AssumedLearning {
  std::string group, condition;
  double asymptote = 0;  ///< after many trials
  double gain = 0;       ///< what the first trial is worse by, at trial 0; 0: nobody learns
  double rate = 0;       ///< 1/trial
};

/// Scores without any needle:  y = asymptote + gain exp(-rate (trial - 1)) + u + e,  u ~ N(0,
/// subject_sd^2) once a subject, e ~ N(0, residual_sd^2). An exponential learning curve (Heathcote,
/// Brown and Mewhort, Psychon. Bull. Rev. 7, 2000). Nobody's real skill; for planning and for
/// testing the analyses.
struct LearningModel {
  std::string metric;
  std::vector<AssumedLearning> curves;
  double subject_sd = 0, residual_sd = 0;
};

/// The paracentesis pilot as Tzafestas 2008 printed it, in "total" and "time_s": means of the first
/// and last two trials of tables 3 and 4, the means of table 5 for those who do not learn any more;
/// rate 0.35 per trial and how the printed spread divides between subjects (a third of the
/// variance) and trials [chosen].
std::vector<LearningModel> pilotModels();

/// The same without any effect: nobody learns, groups and conditions do not differ.
std::vector<LearningModel> nullModels();

/// What is drawn: in each curve's cell `subjects` people with `trials` trials. All rows are marked
/// as simulated. The same for the same seed.
std::vector<StudyRow> drawStudy(const std::vector<LearningModel>& models, int subjects, int trials,
                                std::uint64_t seed);

/// How often an analysis called something an effect, by the very tests of the page.
struct Detections {
  int studies = 0;
  int groups = 0,
      learning = 0;  ///< one value a subject, two-sided: Welch between groups, paired within
  int groups_published = 0,
      /// Trials pooled, one-tailed: experienced people have smaller figures, figures fall with
      /// practice
      learning_published = 0;
};

struct DrawnStudies {
  int studies = 2000;
  int subjects = 5;  ///< in each group and condition: 20 in all, as Tzafestas 2008
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
