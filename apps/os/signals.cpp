#include "apps/os/signals.h"

#include <atomic>
#include <csignal>
#include <iterator>

namespace palpa::os {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM};
std::atomic<bool> interrupted{false};  // a signal may come on any thread
static_assert(std::atomic<bool>::is_always_lock_free);
struct sigaction old_actions[std::size(kSignals)];

void note(int) { interrupted.store(true); }
void passOver(int) {}

}  // namespace

void letLargeFilesFail() {
  struct sigaction action {};
  action.sa_handler = passOver;  // not ignored: programs that are started would inherit that
  action.sa_flags = SA_RESTART;
  sigaction(SIGXFSZ, &action, nullptr);
}

InterruptNote::InterruptNote(Again again) {
  interrupted.store(false);
  struct sigaction action {};
  action.sa_handler = note;
  if (again == Again::kills) action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < std::size(kSignals); ++i)
    sigaction(kSignals[i], &action, &old_actions[i]);
}

InterruptNote::~InterruptNote() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i)
    sigaction(kSignals[i], &old_actions[i], nullptr);
}

bool InterruptNote::noted() const { return interrupted.load(); }

}  // namespace palpa::os
