#pragma once

#include <filesystem>
#include <vector>

#include "apps/evidence/recorded_session.h"

namespace palpa::evidence {

/// What was exported of a session.
struct SessionExport {
  std::vector<std::filesystem::path> files;
  ReplayCheck check;  ///< of the ticks, which were run again for what their forces are made of
};

/// Writes three files, all or none: `csv`, every tick (record::exportTicks) with what its force is
/// made of, as running it again tells; beside it the dictionary of its columns (.columns.txt) and
/// the session's laws (.laws.json). A tick that could not be run again, or comes out changed, has
/// its recorded columns alone. Nothing is written into the session. Throws Error.
SessionExport exportSession(const record::SessionReader& reader, const std::filesystem::path& csv);

}  // namespace palpa::evidence
