#pragma once

#include "apps/cli/recorded_trial.h"

namespace palpa::cli {

/// A trial of a palpation, a search or a comparison, ready to be shown. `engine`: of the recorded
/// task. Throws as recordedShow.
std::unique_ptr<RecordedShow> recordedTouch(const std::filesystem::path& file,
                                            const std::string& engine, int number);

}  // namespace palpa::cli
