#pragma once

#include "apps/calibrate/result.h"
#include "apps/calibrate/subtask_recordings.h"
#include "apps/calibrate/subtask_segmentation.h"

namespace palpa::calibrate {

inline constexpr double kRepeats = 0.8;  ///< adjusted Rand index of two halves of the trials from
                                         ///< which on a segmentation is called repeatable [chosen]

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
