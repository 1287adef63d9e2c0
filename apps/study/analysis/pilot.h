#pragma once

#include <vector>

#include "apps/assess/statistics/bootstrap.h"
#include "apps/study/analysis/comparison.h"
#include "apps/study/analysis/series.h"
#include "apps/study/analysis/study_design.h"

namespace palpa::study_analysis {

/// The two figures that the pilot looks at, in the order of Tzafestas et al. 2008.
inline const std::vector<std::string> kPilotMetrics{"time_s", "total"};

/// How one group learned under one condition, in one figure.
struct LearningCell {
  std::string metric, group, condition;
  std::size_t left_out = 0;            ///< subjects with too few trials
  Comparison test;                     ///< last two against first two, paired, one value a subject
  statistics::BootstrapInterval rate;  ///< 1 - last / first, subjects resampled
  std::vector<double> rates;           ///< a subject each
  /// 95 % interval of the fall by Student's t, over the mean of the first two
  double rateLow() const { return -test.high / test.b.mean; }
  double rateHigh() const { return -test.low / test.b.mean; }
};

/// Everything that the tables of the pilot are made of. Source: Tzafestas, Birbas, Koumpouros,
/// Christopoulos, Presence 17(2), 2008, section 3.3; there trials were pooled (`*_published`), here
/// each subject counts once.
struct Pilot {
  std::string learners,
      experts;  ///< first and second group; experts empty: there is one group only
  std::vector<std::string> conditions;
  std::vector<LearningCell> learning;  ///< of the first group: by condition, then figure
  /// learning rates of the second condition against the first
  std::vector<Comparison> learning_between;
  std::vector<Comparison> groups;  ///< second group against the first, by condition, then figure
  std::vector<Comparison> learning_published, groups_published;
};

/// Throws UsageError where no group or no figure of the pilot is in the rows.
Pilot pilotOf(const std::vector<StudyRow>& rows, const StudyDesign& design);

StudyResult analysePilot(const std::vector<StudyRow>& rows, const StudyDesign& design);

/// Parts of it.
std::vector<Exhibit> pilotFigures(const std::vector<StudyRow>& rows, const StudyDesign& design,
                                  const Pilot& pilot);
std::vector<Exhibit> pilotTables(const std::vector<StudyRow>& rows, const StudyDesign& design,
                                 const Pilot& pilot);
std::vector<Exhibit> pilotPublished(const StudyDesign& design, const Pilot& pilot);
std::vector<std::string> pilotFindings(const StudyDesign& design, const Pilot& pilot);

}  // namespace palpa::study_analysis
