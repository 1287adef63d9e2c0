#pragma once

#include <vector>

#include "apps/record/session_file.h"
#include "apps/task_squeeze/squeeze_task.h"

namespace palpa::cli {

struct RecordedSqueeze {
  record::RecordedTrial recorded;
  assess::SqueezeTrial again;  ///< from the ticks and what was said
};
/// Every trial of a comparison session judged again, from the evidence alone. Throws Error for a
/// record whose parts contradict each other.
std::vector<RecordedSqueeze> recordedSqueezes(const record::SessionReader& reader);

}  // namespace palpa::cli
