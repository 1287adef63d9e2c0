#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace palpa::console {

/// What a console's home keeps of one person; the sessions' results are not its own.
struct PersonTraces {
  std::size_t jobs = 0, lines = 0, sessions = 0;  ///< jobs and lines of logs removed; folders
  std::size_t launches = 0;                       ///< of learning management systems
  std::vector<std::string> troubles;              ///< what could not be removed, in words
};

/// Folders of sessions that were begun here for a trainee; none where `home` is no console's.
std::vector<std::filesystem::path> sessionsOf(const std::filesystem::path& home,
                                              const std::string& trainee);

/// Removes the request, the log and the drawn replays of such a session; its folder where nothing
/// else is left in it.
void removeSessionTraces(const std::filesystem::path& folder, PersonTraces* traces);

/// Removes every job with the name in one of its files (all can be made again), the lines of the
/// console's own logs that hold it, and launches; what of these was not sent yet is not sent.
void removeHomeTraces(const std::filesystem::path& home, const std::string& trainee,
                      PersonTraces* traces);

}  // namespace palpa::console
