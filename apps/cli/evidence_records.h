#pragma once

#include <filesystem>
#include <vector>

#include "apps/record/store/rows.h"

namespace palpa::cli {

/// A session as the records of a centre keep it, made from its evidence alone.
struct EvidenceRecords {
  record::StoredSession session;
  std::vector<record::StoredTrial> trials;  ///< that ended, each with every figure, judged again
  int unfinished =
      0;  ///< trials in whose middle the program stopped: they stay in the evidence only
};

/// Throws Error for a file that is none or damaged.
EvidenceRecords recordsOf(const std::filesystem::path& evidence);

}  // namespace palpa::cli
