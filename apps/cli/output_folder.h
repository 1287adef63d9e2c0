#pragma once

#include <filesystem>
#include <string>

#include "apps/runtime/serving_clock.h"

namespace palpa::cli {

/// `given`, else out/<command>-<time>; made, and proven writable before any work is done. Throws
/// Error.
std::filesystem::path makeOutputFolder(const std::string& given, const std::string& command);

/// "2026-03-01T12:30:00Z"
using runtime::utcNow;

}  // namespace palpa::cli
