#pragma once

#include <functional>
#include <string>
#include <thread>

namespace palpa::os {

/// Keeps the whole process in memory while it lives, so that no tick waits for a page: what is
/// there, and what comes later where the kernel sets no bound on it. Where it does, only what is
/// there: locking what comes would make a later allocation fail. One at a time.
class MemoryLock {
 public:
  MemoryLock();
  ~MemoryLock();
  MemoryLock(const MemoryLock&) = delete;
  MemoryLock& operator=(const MemoryLock&) = delete;
  /// "memory locked", "memory of the start locked: ...", "memory not locked: ...".
  const std::string& words() const { return words_; }

 private:
  std::string words_;
  bool locked_ = false;
};

/// Prepares the calling thread for steps in time: SCHED_FIFO where allowed, `cpu` where one is
/// named (-1: any), 256 KiB of its stack touched beforehand. Says what it got, and why not what it
/// did not get: "SCHED_FIFO", "normal priority: SCHED_FIFO refused (this user may not); CPU 3
/// refused (this computer has none)".
std::string becomeRealTime(int cpu);

/// A thread that does `work`. Throws Error where the system gives no further one.
std::thread startThread(std::function<void()> work);

/// Threads that this process and its libraries start from now on have a stack of 2 MiB instead of
/// the 8 that are usual. Where memory is locked all of it is held, and that of a few threads that
/// have ended as well (glibc keeps 40 MB of such). Not for a server: what parses a hostile request
/// may go deep.
void keepStacksSmall();

/// The calling thread gives way to all others that want to run.
void giveWay();

/// All threads of this process share two pools of memory from now on. With one pool a thread, as is
/// usual, each keeps what it once needed: a server of many threads grows by as many answers.
void shareMemoryPools();

/// Pieces of half a megabyte and more, as pictures are, go back to the system as soon as they are
/// free. As is usual they stay with the process, whose memory is then as large as everything ever
/// was at once: in a session of hours, at every hitch of the computer, a little more.
void giveLargeMemoryBack();

/// What is free now goes back to the system, also between pieces that are in use. Some milliseconds
/// in which other threads may wait for memory.
void giveFreeMemoryBack();

}  // namespace palpa::os
