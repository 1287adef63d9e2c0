#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/subtask_result.h"

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
