#pragma once

#include <filesystem>
#include <string>

namespace palpa::bench {

struct PlayedSession {
  std::filesystem::path recorded;  ///< a session.palpa
  std::filesystem::path out;       ///< folder of the new one
  std::string live;                ///< its local socket
  std::string trainee, records;    ///< who; where its trials go: empty: nobody is recorded
};

/// Holds a recorded session once more, at its own speed, as whoever looks on and whoever reads its
/// record sees a session: every tick, event and trial goes through the live log into a new record
/// of its own. Until its end, or Ctrl-C. Throws Error.
void playSession(const PlayedSession& played);

}  // namespace palpa::bench
