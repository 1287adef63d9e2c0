#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/competence/verdict.h"

namespace palpa::report {

/// A form for a human rater, as paper has it.
struct RatingForm {
  const competence::Checklist* checklist = nullptr;
  const competence::GlobalRating* global = nullptr;  ///< null: without
  std::string trainee, session, when;                ///< of the trial; empty: lines to write on
  int trial = 0;
  bool simulated = false;
  /// what the simulator says, shown faintly; empty: a blank form
  std::vector<competence::MarkedItem> marks = {};
};

/// One self-contained page for A4, black on white. The rater's boxes stay empty: what the simulator
/// says stands faintly beside them.
void writeRatingForm(const RatingForm& form, const std::filesystem::path& file);

/// "item,value" lines with the items' codes, to be filled in from the paper: what `palpa rate
/// enter` reads.
std::string answerSheet(const competence::Checklist& checklist,
                        const competence::GlobalRating* global);

}  // namespace palpa::report
