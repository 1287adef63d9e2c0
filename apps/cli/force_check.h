#pragma once

#include <optional>

#include "apps/assess/force_balance.h"
#include "apps/record/session_file.h"

namespace palpa::cli {

/// Whether the forces in a record add up, over all its trials; none where the device measured
/// neither hand nor itself. Throws Error for a description that is damaged.
std::optional<assess::ForceBalance> recordedBalance(const record::SessionReader& reader);

}  // namespace palpa::cli
