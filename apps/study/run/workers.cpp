#include "apps/study/run/workers.h"

#include <atomic>
#include <cstdio>
#include <cstring>
#include <exception>

#include "anatomy/base/error.h"
#include "apps/os/worker_processes.h"
#include "apps/runtime/clock.h"

namespace palpa::study {
namespace {

constexpr std::int64_t kLook = 200 * runtime::kMillisecond;
constexpr std::int64_t kSay = 5 * runtime::kSecond;

/// What the processes share.
struct WorkerTally {
  std::atomic<int> next{0}, done{0}, failed{0};
  char message[512] = {};
};

using Work = std::function<void(int, const std::function<void()>&)>;

void workThrough(WorkerTally& board, int items, const Work& work) {
  try {
    for (int item; !board.failed && (item = board.next++) < items;)
      work(item, [&board] { ++board.done; });
  } catch (const std::exception& e) {
    if (board.failed++ == 0) std::strncpy(board.message, e.what(), sizeof board.message - 1);
  }
}

void say(const WorkerTally& board, int steps) {
  std::fprintf(stderr, "%d of %d trials\n", board.done.load(), steps);
}

/// Until all have ended; true: somebody was killed.
bool watchOver(int children, const WorkerTally& board, int steps, bool quiet) {
  runtime::SteadyClock clock;
  std::int64_t said_ns = 0;
  bool killed = false;
  for (int ended = 0; ended < children;) {
    if (const std::optional<os::EndedWorker> worker = os::takeEnded()) {
      ++ended;
      killed = killed || !worker->clean;
      continue;
    }
    const std::int64_t now = clock.now();
    clock.sleepUntil(now + kLook);
    if (quiet || now - said_ns < kSay) continue;
    said_ns = now;
    say(board, steps);
  }
  return killed;
}

}  // namespace

void shareWork(int items, int workers, int steps, bool quiet, const Work& work) {
  const os::SharedMemory<WorkerTally> shared("Use --workers 1");
  WorkerTally& board = *shared;
  int children = 0;
  for (int i = 0; i < workers && i < items; ++i)
    children += os::forkWorker([&] { workThrough(board, items, work); });
  if (children == 0) workThrough(board, items, work);  // no process to be had
  const bool killed = watchOver(children, board, steps, quiet);
  if (!quiet) say(board, steps);
  if (board.failed)
    throw Error(board.message, "a virtual trainee",
                "Start again: what is done is kept, the same command continues");
  if (killed)
    throw Error("was killed", "a process of the simulation",
                "Start again: what is done is kept, the same command continues");
}

}  // namespace palpa::study
