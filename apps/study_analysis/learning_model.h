#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/study_analysis/study_row.h"

namespace palpa::study_analysis {

/// How one group does under one condition.
struct LearningCurve {
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
  std::vector<LearningCurve> curves;
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

}  // namespace palpa::study_analysis
