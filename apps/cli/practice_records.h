#pragma once

#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/record/store/record_store.h"

namespace palpa::cli {

/// Trials as the pages of practice take them. `group`: the trainee's. Throws Error for a session
/// whose description is damaged.
progress::PracticeTrial practiceOf(const record::TrialWithSession& stored,
                                   const std::string& group);

/// Which trials a page is about; an empty text means any.
struct PracticeChoice {
  std::string trainee, group, task;
};
std::vector<progress::PracticeTrial> practiceIn(record::RecordStore& store,
                                                const PracticeChoice& choice);

}  // namespace palpa::cli
