#pragma once

#include <vector>

#include "apps/record/session_file.h"
#include "apps/task_palpation/palpation_task.h"

namespace palpa::cli {

/// A palpation as its evidence tells it, judged again.
struct RecordedPalpation {
  record::RecordedTrial recorded;
  assess::PalpationAssessment assessment;
};

/// Needs nothing but the file: lumps and grades from its events, touches from its ticks, rules from
/// its task. Throws Error.
std::vector<RecordedPalpation> recordedPalpations(const record::SessionReader& reader);

/// "needle", "palpation": of the recorded task.
std::string engineOf(const record::SessionReader& reader);

}  // namespace palpa::cli
