#pragma once

namespace palpa::os {

/// From now on a write past the limit of a file's size fails, as one on a full disk does, instead
/// of ending the program.
void letLargeFilesFail();

/// Sends this process what another one may send it to end it (SIGUSR1). To be noted: see below.
void signalThisProcess();

/// While it lives, Ctrl-C and what else asks a program to end (SIGTERM, SIGQUIT, SIGUSR1, SIGUSR2,
/// SIGHUP: its terminal is gone) is noted instead of ending it, and a reader of its output who has
/// gone away (SIGPIPE) does not end it either: writing there fails, and nothing more. Of SIGHUP,
/// SIGQUIT and the two of the user those that were ignored stay ignored, as `nohup` asks. One
/// within another notes what the outer one does; the old handlers come back with the last.
class InterruptNote {
 public:
  enum class Again {
    kills,  ///< the first one is noted, a second one from the keyboard or by SIGTERM ends the
            ///< program; system calls are resumed
    noted   ///< so is every further one; system calls return early
  };
  explicit InterruptNote(Again again = Again::kills);
  ~InterruptNote();
  InterruptNote(const InterruptNote&) = delete;
  InterruptNote& operator=(const InterruptNote&) = delete;
  bool noted() const;
};

}  // namespace palpa::os
