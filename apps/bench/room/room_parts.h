#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::bench {

/// What a process of `palpa bench room` is told, in a file.
struct RoomPart {
  std::filesystem::path home, pairing;  ///< station: its console's folder; its place in the room
  std::string sockets;                  ///< station: folder of its sessions'
  /// station: what its sessions are: this program's words; empty: it holds none and tells what it
  /// has
  std::vector<std::string> holds;
  std::filesystem::path held;  ///< station: made with the one session that it holds; empty: many
  std::filesystem::path recorded;  ///< play: what is played
  std::filesystem::path result;    ///< session: lateness of its haptic tick, JSON
  double seconds = 0;              ///< session: how long it lasts
  std::uint64_t seed = 1;          ///< session
  std::string trainee, records;    ///< play, session
};
void write(const std::filesystem::path& file, const RoomPart& part);

/// Whether `words` are those of such a process ("bench-room-part KIND FILE ..."), started by the
/// bench or by another part alone. KIND: `station`, a console without pages, whose sessions the
/// room hears of; `session`, one on the virtual bench in real time; `play`, a recorded one. Both
/// take `--live SOCKET --out DIR` as all sessions do.
bool isRoomPart(const std::vector<std::string>& words);
std::vector<std::string> wordsOf(const char* kind, const std::filesystem::path& file);
/// Its whole life. Throws Error.
void beRoomPart(const std::vector<std::string>& words);

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
