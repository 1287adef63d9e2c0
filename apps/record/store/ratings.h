#pragma once

#include "apps/record/store/record_store.h"

namespace palpa::record {

/// What a human rater said of one item of a form, about one trial. Forms and values are the form's:
/// apps/assess/competence.
struct Rating {
  std::string session;
  std::int64_t number = 0;        ///< of the trial
  std::string rater;              ///< a pseudonym
  std::string form, form_sha256;  ///< which form, and which edition of it
  std::string item;
  std::int64_t value = 0;
  std::string entered_utc;
};

/// All ratings of one rater, form and trial, in one transaction; what he said before of that trial
/// on that form is replaced, so that a slip of typing can be mended. Throws UsageError for a trial
/// that is not in the records, a rater's name that is no pseudonym, or ratings of several trials,
/// raters or forms at once.
void enterRatings(RecordStore& store, const std::vector<Rating>& ratings);

/// Those of a session, or all where `session` is empty; by session, trial, rater, form, item.
std::vector<Rating> ratingsIn(RecordStore& store, const std::string& session = "");

}  // namespace palpa::record
