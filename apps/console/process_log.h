#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace palpa::console {

/// The last lines of a log, without what a terminal would make of them.
std::vector<std::string> lastLines(const std::filesystem::path& log, std::size_t most);
/// Of the last line that begins with "palpa: ": what went wrong; empty: nothing was said.
std::string complaintIn(const std::filesystem::path& log);

}  // namespace palpa::console
