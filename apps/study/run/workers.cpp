#include "apps/study/run/workers.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <vector>

#include "anatomy/base/error.h"
#include "apps/runtime/clock.h"

namespace palpa::study {
namespace {

constexpr std::int64_t kLook = 200 * runtime::kMillisecond;
constexpr std::int64_t kSay = 5 * runtime::kSecond;

/// What the processes share.
struct Board {
  std::atomic<int> next{0}, done{0}, failed{0};
  char message[512] = {};
};

class SharedBoard {
 public:
  SharedBoard() {
    void* memory =
        ::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
      throw Error("cannot be shared among processes", "memory", "Use --workers 1");
    board_ = new (memory) Board;
  }
  ~SharedBoard() { ::munmap(board_, sizeof(Board)); }
  SharedBoard(const SharedBoard&) = delete;
  SharedBoard& operator=(const SharedBoard&) = delete;
  Board& operator*() const { return *board_; }

 private:
  Board* board_ = nullptr;
};

using Work = std::function<void(int, const std::function<void()>&)>;

void workThrough(Board& board, int items, const Work& work) {
  try {
    for (int item; !board.failed && (item = board.next++) < items;)
      work(item, [&board] { ++board.done; });
  } catch (const std::exception& e) {
    if (board.failed++ == 0) std::strncpy(board.message, e.what(), sizeof board.message - 1);
  }
}

void say(const Board& board, int steps) {
  std::fprintf(stderr, "%d of %d trials\n", board.done.load(), steps);
}

/// Until all have ended; true: somebody was killed.
bool watchOver(const std::vector<pid_t>& children, const Board& board, int steps, bool quiet) {
  runtime::SteadyClock clock;
  std::int64_t said_ns = 0;
  bool killed = false;
  for (std::size_t ended = 0; ended < children.size();) {
    int status = 0;
    const pid_t child = ::waitpid(-1, &status, WNOHANG);
    if (child > 0) {
      ++ended;
      killed = killed || !WIFEXITED(status) || WEXITSTATUS(status) != 0;
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
  const SharedBoard shared;
  Board& board = *shared;
  std::fflush(stdout);
  std::vector<pid_t> children;
  for (int i = 0; i < workers && i < items; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // nobody works on for a parent that was killed
      workThrough(board, items, work);
      std::fflush(stdout);
      ::_exit(0);
    }
    if (child > 0) children.push_back(child);
  }
  if (children.empty()) workThrough(board, items, work);  // no process to be had
  const bool killed = watchOver(children, board, steps, quiet);
  if (!quiet) say(board, steps);
  if (board.failed)
    throw Error(board.message, "a virtual trainee",
                "Start again: what is done is kept, the same command goes on");
  if (killed)
    throw Error("was killed", "a process of the simulation",
                "Start again: what is done is kept, the same command goes on");
}

}  // namespace palpa::study
