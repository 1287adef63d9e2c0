#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/calibrate/result.h"

namespace palpa::calibrate {

/// What the page says on top.
struct PageHead {
  std::string station, date;
  bool simulated = false;
  double seconds = 0;                ///< how long the set-up took; 0: not said
  std::vector<std::string> remarks;  ///< below the results: accuracy on the virtual bench, refusals
};

/// One self-contained HTML page for an educator: what is good, what is not, when to redo it; then
/// figures and plots. Written whole. Throws Error.
void writePage(const PageHead& head, const std::vector<Result>& results,
               const std::filesystem::path& file);

}  // namespace palpa::calibrate
