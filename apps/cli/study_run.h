#pragma once

#include "apps/cli/study_options.h"

namespace palpa::cli {

/// Leads one trainee through the next session of a protocol: blocks, rests, questionnaire; begins
/// where he left off. Throws UsageError or Error.
void runStudySession(const StudyOptions& options);

/// Fills a protocol with virtual trainees who learn. Throws UsageError or Error.
void simulateStudy(const StudyOptions& options);

/// Who is enrolled, who is next, how far everybody is; nothing that tells a condition before it is
/// used, nor where the protocol is blind. Throws Error.
void tellStudy(const StudyOptions& options);

}  // namespace palpa::cli
