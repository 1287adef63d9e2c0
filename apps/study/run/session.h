#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/record/store/study_store.h"
#include "apps/session/session_options.h"
#include "apps/study/progress.h"
#include "apps/study/protocol.h"
#include "apps/study/run/participant.h"

namespace palpa::study {

/// The options of a session that holds the next trials of a study: what the block's condition shows
/// and lets feel, its task, its chances, which are the same for every trainee; nothing that is
/// otherwise offered to beginners (demonstration, a first try of its own).
session::SessionOptions studySession(const session::SessionOptions& place,
                                     const study::Protocol& protocol,
                                     const record::Enrolment& enrolment, const study::Next& next);

/// A folder that is not there yet: <out>/<trainee>/<step>-<block>[-<trial>].
std::filesystem::path studyFolder(const std::string& out, const study::Protocol& protocol,
                                  const std::string& trainee, const study::Next& next);

/// Asks what is still open of a session's questionnaire, item by item, on the terminal; every
/// answer is kept at once. False: left before the end; the same command continues there.
bool askQuestions(const study::Questionnaire& questionnaire, const study::Next& next,
                  StudyParticipant& participant);

/// Takes the answers from a JSON file of items and answers ({"useful": 4, "remarks": "..."}). All
/// are checked before the first is kept. False: some are still open. Throws UsageError.
bool takeAnswers(const std::string& file, const study::Questionnaire& questionnaire,
                 const study::Next& next, StudyParticipant& participant);

}  // namespace palpa::study
