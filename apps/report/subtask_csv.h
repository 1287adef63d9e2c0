#pragma once

#include <string>
#include <vector>

#include "apps/assess/subtask_dose.h"

namespace palpa::report {

/// Column names of what each part of a task was given, every one after a comma: <NAME>_ON_S
/// <NAME>_TIMES <NAME>_AUGMENTED_S <NAME>_IMPULSE_NS, the part's name in capitals, with _ for
/// whatever is no letter or digit.
std::string subtaskColumns(const std::vector<assess::SubtaskDose>& parts);

/// The fields that belong under them, every one after a comma; empty for a part that is not in
/// `doses`.
std::string subtaskFields(const std::vector<assess::SubtaskDose>& parts,
                          const std::vector<assess::SubtaskDose>& doses);

}  // namespace palpa::report
