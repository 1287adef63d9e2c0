#pragma once

namespace palpa::os {

/// From now on a write past the limit of a file's size fails, as one on a full disk does, instead
/// of ending the program.
void letLargeFilesFail();

/// While it lives, Ctrl-C or SIGTERM is noted instead of ending the program. One at a time; the old
/// handlers come back at its end.
class InterruptNote {
 public:
  enum class Again {
    kills,  ///< the first one is noted, a second one ends the program; system calls are resumed
    noted   ///< so is every further one; system calls return early
  };
  explicit InterruptNote(Again again = Again::kills);
  ~InterruptNote();
  InterruptNote(const InterruptNote&) = delete;
  InterruptNote& operator=(const InterruptNote&) = delete;
  bool noted() const;
};

}  // namespace palpa::os
