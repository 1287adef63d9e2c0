#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/study_row.h"

namespace palpa::study_analysis {

enum class StudyKind { general, paracentesis_pilot, search_study };

/// "general" or "", "paracentesis pilot", "search study". Throws UsageError for another, naming
/// `where`.
StudyKind studyKindNamed(const std::string& name, const std::string& where);

/// What is asked of the rows.
struct StudyDesign {
  StudyKind kind = StudyKind::general;
  std::string title = "Study";
  std::vector<std::string> groups,
      conditions;  ///< in the order of the protocol; what is not named follows as it appears
  /// how groups, conditions and blocks are called in sentences; default: by their name
  std::map<std::string, std::string> words;
  std::vector<std::string> metrics;  ///< of the general analysis; empty: all that vary
  bool as_published = false;         ///< beside: as the published study did
  std::uint64_t seed = 1;            ///< of the bootstrap
};

/// The whole analysis. Throws UsageError where the rows lack what the kind of study needs, Error
/// where nothing can be computed.
StudyResult analyseStudy(const std::vector<StudyRow>& rows, const StudyDesign& design);

std::string inWords(const StudyDesign& design, const std::string& name);

/// Groups or conditions of the rows, those of the design first and in its order.
std::vector<std::string> groupsOf(const std::vector<StudyRow>& rows, const StudyDesign& design);
std::vector<std::string> conditionsOf(const std::vector<StudyRow>& rows, const StudyDesign& design);

}  // namespace palpa::study_analysis

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

/// For a study without an analysis of its own: every figure by group and condition, over subjects;
/// each group against the first under each condition (Welch), each condition against the first
/// (paired where the same subjects did both, else Welch), all corrected together.
StudyResult analyseGeneral(const std::vector<StudyRow>& rows, const StudyDesign& design);

}  // namespace palpa::study_analysis
