#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpa::os {

/// A process of this program, as it can be found again by another one later.
struct ProcessId {
  int pid = 0;
  std::uint64_t began =
      0;  ///< of the kernel, ticks since boot: tells it from a later process with the same number
  bool operator==(const ProcessId&) const = default;
};

/// Starts this program anew with `arguments`: in a session of its own, so that it outlives whoever
/// started it; output goes to `log`; nothing of ours stays open in it. Throws Error.
ProcessId start(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                bool gives_way);
/// It runs. A child of ours that ended is put away.
bool runs(const ProcessId& process);
/// Asks it to end, as Ctrl-C does.
void askToEnd(const ProcessId& process);

/// The last lines of a log, without what a terminal would make of them.
std::vector<std::string> lastLines(const std::filesystem::path& log, std::size_t most);
/// Of the last line that begins with "palpa: ": what went wrong; empty: nothing was said.
std::string complaintIn(const std::filesystem::path& log);

}  // namespace palpa::os
