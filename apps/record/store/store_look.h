#pragma once

#include <cstddef>
#include <string>

namespace palpa::record {

/// What is found in the place of a store.
enum class StoreState {
  absent,  ///< no such file: the first trainee makes it
  empty,   ///< a file of no bytes, or a store without tables
  older,   ///< tables of an older version: the next program that uses it brings them to the newest
  current
};

/// What a store is, seen from outside.
struct StoreLook {
  StoreState state = StoreState::absent;
  int schema = 0;  ///< version of its tables
  std::size_t trainees = 0;
  std::string place;  ///< for messages; never a password
};

/// Looks and changes nothing: neither migrates nor makes anything, not a byte of a file or its log.
/// Throws Error for a store that is damaged, of another program, newer than this program, or (a
/// file) may not be written by this user; StoreUnreachable; UsageError for an address that is none.
StoreLook lookAtStore(const std::string& url);

}  // namespace palpa::record
