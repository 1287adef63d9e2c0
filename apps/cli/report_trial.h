#pragma once

#include <CLI/CLI.hpp>

namespace palpa::cli {

/// `palpa report trial`: one trial of a needle session, judged, as a page.
void addReportTrial(CLI::App& report);

}  // namespace palpa::cli
