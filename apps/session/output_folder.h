#pragma once

#include <filesystem>
#include <string>

namespace palpa::session {

/// `given`, else out/<command>-<time>; made, and proven writable before any work is done. Throws
/// Error.
std::filesystem::path makeOutputFolder(const std::string& given, const std::string& command);

}  // namespace palpa::session
