#pragma once

#include <filesystem>
#include <string>

#include "apps/assess/competence/verdict.h"
#include "apps/assess/needle/trial_assessment.h"
#include "apps/record/store/study_store.h"

namespace palpa::evidence {

/// Checklist and global rating, from their files; empty: the shipped ones.
struct RatingForms {
  competence::Checklist checklist;
  competence::GlobalRating global;
  std::string checklist_sha256, global_sha256;
};
RatingForms readForms(const std::string& checklist,
                      const std::string& global);  ///< throws UsageError

/// The text of a file. Throws UsageError.
std::string textOf(const std::filesystem::path& file);

/// A share of the checklist's standards from per cent; 0: the first. Throws UsageError for one that
/// the checklist does not have.
double standardOf(const competence::Checklist& checklist, double percent);

/// What a rater said of a trial, from the records. Throws UsageError for sheets of another edition
/// of the forms.
competence::FormAnswers answersIn(const std::vector<record::Rating>& ratings, std::int64_t trial,
                                  const std::string& rater, const RatingForms& forms);

/// The figures of a trial by name.
competence::Figures figuresOf(const assess::TrialAssessment& assessment);
competence::Figures figuresOf(const record::StoredTrial& trial);

/// A trial of these forms, judged.
competence::Verdict verdictOf(const assess::TrialAssessment& assessment, const RatingForms& forms,
                              const competence::FormAnswers& answers, double standard);

}  // namespace palpa::evidence
