#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/assess/trial.h"
#include "apps/report/page/html.h"

namespace palpa::report {

/// What the parts of a task are called and what they mean, in words.
using SubtaskMeanings = std::vector<std::pair<std::string, std::string>>;

/// The doses of several trials, summed by the name of the part, in the order in which the names
/// first occur.
std::vector<assess::SubtaskDose> dosesSummed(
    const std::vector<std::vector<assess::SubtaskDose>>& trials);

/// A table, one row a part of the task: how long it was on, of `seconds` in all, how often it came
/// on, and, where any cue was felt, how long and how much force the cues added. Parts without a
/// meaning stand without one; nothing is written where there are no doses. Its style:
/// subtaskTableStyle().
void writeSubtaskTable(Html& html, const std::vector<assess::SubtaskDose>& doses,
                       const SubtaskMeanings& meanings, double seconds);

/// What the figures of the table mean: stands once below one or several of them.
void writeSubtaskNote(Html& html);

/// What the parts of a task were given in a session.
struct SubtaskSection {
  std::vector<std::vector<assess::SubtaskDose>> trials;
  SubtaskMeanings meanings;
  double seconds = 0;  ///< of all trials
  int augmented = 0;   ///< trials in which cues were on
};
/// A section of its own; nothing where the task has no parts.
void writeSubtaskSection(Html& html, const SubtaskSection& section);

/// For writeHeadElement.
std::string_view subtaskTableStyle();

/// Column names of what each part of a task was given, every one after a comma: <NAME>_ON_S
/// <NAME>_TIMES <NAME>_AUGMENTED_S <NAME>_IMPULSE_NS, the part's name in capitals, with _ for
/// whatever is no letter or digit.
std::string subtaskColumns(const std::vector<assess::SubtaskDose>& parts);

/// The fields that belong under them, every one after a comma; empty for a part that is not in
/// `doses`.
std::string subtaskFields(const std::vector<assess::SubtaskDose>& parts,
                          const std::vector<assess::SubtaskDose>& doses);

}  // namespace palpa::report
