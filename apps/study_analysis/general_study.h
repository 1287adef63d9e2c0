#pragma once

#include <vector>

#include "apps/study_analysis/study_design.h"

namespace palpa::study_analysis {

/// For a study without an analysis of its own: every figure by group and condition, over subjects;
/// each group against the first under each condition (Welch), each condition against the first
/// (paired where the same subjects did both, else Welch), all corrected together.
StudyResult analyseGeneral(const std::vector<StudyRow>& rows, const StudyDesign& design);

}  // namespace palpa::study_analysis
