#pragma once

#include <filesystem>
#include <string>

#include "apps/calibrate/subtask_recordings.h"
#include "apps/calibrate/subtask_result.h"
#include "apps/calibrate/subtask_segmentation.h"
#include "apps/report/page/html.h"

namespace palpa::calibrate {

/// What trials that were held out say to each number of states, with standard errors; below, how
/// well two halves repeat it. The number taken is ringed.
void drawStatesCurve(report::Html& html, const SubtaskSegmentation& found);

/// A trial over time: a lane a hand-written part, a lane a proposed state below. What is what is
/// told by the lanes; colours only help.
void drawTrialStrip(report::Html& html, const SubtaskRecordings& recordings,
                    const SubtaskSegmentation& found, std::size_t sequence);

/// Added to the page's style sheet.
std::string subtaskChartStyle();

/// One self-contained HTML page for an educator: what is proposed, how it agrees with the
/// hand-written parts, the first trials over time. Written whole. Throws Error.
void writeSubtaskPage(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                      const Result& result, const std::filesystem::path& file);

}  // namespace palpa::calibrate
