#pragma once

#include <string>

#include "apps/session/session_options.h"

namespace palpa::study {

/// What `palpa study run` and `status` understand.
struct StudyOptions {
  std::string protocol, url;
  std::string trainee;    ///< empty: nobody was named
  std::string answers;    ///< file with the questionnaire's answers; empty: they are asked for
  bool simulate = false;  ///< virtual trainees in place of one
  int subjects = 0;       ///< of each group; 0: as the learners' file says
  std::string learners;
  int workers = 2;                  ///< processes
  std::uint64_t seed = 0;           ///< of the study, where it begins; 0: drawn
  session::SessionOptions session;  ///< where and how sessions are held
};

/// Leads one trainee through the next session of a protocol: blocks, rests, questionnaire; begins
/// where he left off. Throws UsageError or Error.
void runStudySession(const StudyOptions& options);

/// Fills a protocol with virtual trainees who learn. Throws UsageError or Error.
void simulateStudy(const StudyOptions& options);

/// Who is enrolled, who is next, how far everybody is; nothing that tells a condition before it is
/// used, nor where the protocol is blind. Throws Error.
void reportStudy(const StudyOptions& options);

}  // namespace palpa::study
