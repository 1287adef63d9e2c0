#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/result.h"
#include "apps/calibrate/subtask_recordings.h"
#include "apps/calibrate/subtask_segmentation.h"

namespace palpa::calibrate {

/// Adjusted Rand index of two halves of the trials from which on a segmentation is called
/// repeatable [chosen]
inline constexpr double kRepeats = 0.8;

/// The segmentation as a file of kind "subtasks", and in words for an educator. Says how the
/// proposed and the hand-written segmentation agree, not which is right. Parameters: states,
/// features used and their standardisation, the model for steps of 10 ms (start; moves row by row;
/// means and variances by feature), the held-out curve, agreement, steps of each label by state.
Result subtaskResult(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                     const Origin& origin);

/// The label that goes with a row of the table of steps: its match, where that is a quarter of the
/// state or more; else "".
std::string partOf(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                   std::size_t row);
/// "2": states are counted from 1 for people.
std::string stateName(const SubtaskSegmentation& found, std::size_t row);

}  // namespace palpa::calibrate

/// A segmentation in plain sentences, as the page and the terminal show them.
namespace palpa::calibrate {

using Sentences = std::vector<std::string>;

/// "12 mm/s, 0.40 N, in contact 100 % of its time, shaking by 0.05 N".
std::string wordsOf(const StateLook& look);
/// What a kappa means: "little agreement". Landis and Koch 1977, Biometrics 33(1), with 0.4 as
/// where it begins to be more than little.
const char* agreementWords(double kappa);
/// How many states are proposed, and whether others would find the same.
Sentences howMany(const SubtaskRecordings& recordings, const SubtaskSegmentation& found);
/// What each state looks like and which hand-written part it is mostly.
Sentences whatTheyAre(const SubtaskRecordings& recordings, const SubtaskSegmentation& found);
/// The measures, beside what chance reaches, and what they mean.
Sentences howTheyAgree(const SubtaskRecordings& recordings, const SubtaskSegmentation& found);
/// Where most steps are called unlike.
Sentences whereTheyDiffer(const SubtaskRecordings& recordings, const SubtaskSegmentation& found);
/// What limits all this.
Sentences whatToMind(const SubtaskRecordings& recordings, const SubtaskSegmentation& found);

}  // namespace palpa::calibrate
