#pragma once

#include <filesystem>

#include "apps/cli/needle_session.h"

namespace palpa::cli {

/// trials.csv, report.html and, for recorded pictures, registration.csv; then the last lines on
/// standard output say what was written.
void writeOutcome(const SessionOptions& options, const NeedleWorld& world,
                  const SessionResult& result, const std::filesystem::path& folder);

}  // namespace palpa::cli
