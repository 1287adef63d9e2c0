#pragma once

#include <filesystem>

#include "apps/calibrate/subtask_result.h"

namespace palpa::calibrate {

/// One self-contained HTML page for an educator: what is proposed, how it agrees with the
/// hand-written parts, the first trials over time. Written whole. Throws Error.
void writeSubtaskPage(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                      const Result& result, const std::filesystem::path& file);

}  // namespace palpa::calibrate
