#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/record/session_file.h"

namespace palpa::record {

/// A column of the tick table: its name ends in its unit where it has one; `meaning` says the rest.
/// SI units throughout, so that every number is the recorded one to its last bit.
struct TickColumn {
  std::string name, meaning;
};

/// The dictionary of `exportTicks`, in the order of the columns.
std::vector<TickColumn> tickColumns();

/// Every recorded tick as one line of comma-separated values under a header line; for statistics
/// programs. Written beside, then renamed. Throws Error.
void exportTicks(const SessionReader& reader, const std::filesystem::path& file);

}  // namespace palpa::record
