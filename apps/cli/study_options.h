#pragma once

#include <string>

#include "apps/cli/session_options.h"

namespace palpa::cli {

/// What `palpa study run` and `status` understand.
struct StudyOptions {
  std::string protocol, url;
  std::string trainee;    ///< empty: nobody was named
  std::string answers;    ///< file with the questionnaire's answers; empty: they are asked for
  bool simulate = false;  ///< virtual trainees in place of one
  int subjects = 0;       ///< of each group; 0: as the learners' file says
  std::string learners;
  int workers = 2;         ///< processes
  std::uint64_t seed = 0;  ///< of the study, where it begins; 0: drawn
  SessionOptions session;  ///< where and how sessions are held
};

}  // namespace palpa::cli
