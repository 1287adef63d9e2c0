#pragma once

#include <string>
#include <vector>

#include "apps/study_analysis/exhibit.h"
#include "apps/study_analysis/study_design.h"

/// What the results of any kind of study have in common.
namespace palpa::study_analysis {

/// Title, groups, counts, what is simulated.
StudyResult framedResult(const std::vector<StudyRow>& rows, const StudyDesign& design,
                         const std::string& kind);

/// What cannot be said: few subjects (`smallest`: in the smallest cell that is tested), several
/// versions, a mixture of people and simulation.
std::vector<std::string> cautionsOf(const StudyResult& result, std::size_t smallest);

/// Why p-values of trials pooled as independent are not to be trusted.
std::vector<std::string> publishedWords();

/// Smallest difference, in standard deviations, that two groups of n subjects show with this power
/// at the two-sided level of 5 %.
double smallestVisibleEffect(std::size_t n, double power = 0.8);

}  // namespace palpa::study_analysis
