#pragma once

#include <string>
#include <vector>

#include "apps/study_analysis/exhibit.h"
#include "apps/study_analysis/study_design.h"

namespace palpa::study_analysis {

/// All trials of a figure at once, in a mixed model with an intercept a subject: group, condition,
/// trial (per trial, from the middle of the course) and their products by two, groups and
/// conditions as -1/2 and +1/2, so that each question is asked at the mean of the others; what has
/// one level is left out. Where it cannot be fitted, a note says why and the table is empty.
Exhibit mixedExhibit(const std::vector<StudyRow>& rows, const StudyDesign& design,
                     const std::string& metric);

}  // namespace palpa::study_analysis
