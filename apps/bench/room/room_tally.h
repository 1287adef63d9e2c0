#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace palpa::bench {

/// What the stations of a room have recorded beside what its watcher has written down.
struct RoomTally {
  std::int64_t recorded = 0;    ///< events that records hold, and that are told
  std::int64_t arrived = 0;     ///< of these, at the watcher, as they were recorded
  std::int64_t missing = 0;     ///< of these, not at the watcher
  std::int64_t doubled = 0;     ///< that he has more than once
  std::int64_t disordered = 0;  ///< that stand before one that came before them
  std::int64_t changed = 0;     ///< that are others than the record's
  /// that he has and that no record holds: a computer that was switched off had told them and not
  /// kept them yet
  std::int64_t beyond = 0;
  std::int64_t records = 0;  ///< session files
  /// Of these, cut off before they could be read: a computer was switched off as it made them.
  std::int64_t cut_off = 0;
};

/// An event, as far as both sides tell it alike.
struct ToldEvent {
  std::int64_t number = 0;  ///< of its record's, 0, 1, ...
  double t_s = 0;
  std::string event;
};
using ByRecord = std::map<std::string, std::vector<ToldEvent>>;  ///< by the records' UUIDs

/// All that is told of the sessions below `home`, by their records. `cut_off`, where given, counts
/// the files that were cut off as they were made.
ByRecord recordedIn(const std::filesystem::path& home, std::int64_t* cut_off = nullptr);
/// Of a station, as the watcher wrote it down in its folder, in the order in which it came.
ByRecord arrivedFrom(const std::string& station, const std::filesystem::path& watch);
void add(const ByRecord& recorded, const ByRecord& arrived, RoomTally* tally);

}  // namespace palpa::bench
