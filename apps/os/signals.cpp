#include "apps/os/signals.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iterator>

namespace palpa::os {
namespace {

struct NotedSignal {
  int number;
  bool kills_again;    ///< by hand; a terminal that closes sends its own twice
  bool stays_ignored;  ///< where it was; who sends one of the others means it
};
constexpr NotedSignal kSignals[] = {{SIGINT, true, false},  {SIGTERM, true, false},
                                    {SIGQUIT, true, true},  {SIGHUP, false, true},
                                    {SIGUSR1, false, true}, {SIGUSR2, false, true}};
std::atomic<bool> interrupted{false};  // a signal may come on any thread
static_assert(std::atomic<bool>::is_always_lock_free);
int notes = 0;  // alive, one within another
struct sigaction old_actions[std::size(kSignals)], old_pipe;

void note(int) { interrupted.store(true); }
void passOver(int) {}

struct sigaction actionOf(const NotedSignal& signal, InterruptNote::Again again) {
  struct sigaction action {};
  action.sa_handler = note;
  if (again == InterruptNote::Again::noted) return action;
  action.sa_flags = SA_RESTART;
  if (signal.kills_again) action.sa_flags |= static_cast<int>(SA_RESETHAND);
  return action;
}

}  // namespace

void letLargeFilesFail() {
  struct sigaction action {};
  action.sa_handler = passOver;  // not ignored: programs that are started would inherit that
  action.sa_flags = SA_RESTART;
  sigaction(SIGXFSZ, &action, nullptr);
}

void signalThisProcess() { ::kill(::getpid(), SIGUSR1); }

InterruptNote::InterruptNote(Again again) {
  if (notes++ > 0) return;
  interrupted.store(false);
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    const struct sigaction action = actionOf(kSignals[i], again);
    sigaction(kSignals[i].number, &action, &old_actions[i]);
    if (kSignals[i].stays_ignored && old_actions[i].sa_handler == SIG_IGN)
      sigaction(kSignals[i].number, &old_actions[i], nullptr);
  }
  struct sigaction nothing {};
  nothing.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &nothing, &old_pipe);
}

InterruptNote::~InterruptNote() {
  if (--notes > 0) return;
  for (std::size_t i = 0; i < std::size(kSignals); ++i)
    sigaction(kSignals[i].number, &old_actions[i], nullptr);
  sigaction(SIGPIPE, &old_pipe, nullptr);
}

bool InterruptNote::noted() const { return interrupted.load(); }

}  // namespace palpa::os
