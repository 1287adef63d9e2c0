#pragma once

#include <string>
#include <vector>

#include "apps/cli/study_participant.h"

namespace palpa::cli {

/// Asks what is still open of a session's questionnaire, item by item, on the terminal; every
/// answer is kept at once. False: left before the end; the same command goes on there.
bool askQuestions(const study::Questionnaire& questionnaire, const study::Next& next,
                  StudyParticipant& participant);

/// Takes the answers from a JSON file of items and answers ({"useful": 4, "remarks": "..."}). All
/// are checked before the first is kept. False: some are still open. Throws UsageError.
bool takeAnswers(const std::string& file, const study::Questionnaire& questionnaire,
                 const study::Next& next, StudyParticipant& participant);

}  // namespace palpa::cli
