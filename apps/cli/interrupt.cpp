#include "apps/cli/interrupt.h"

#include <csignal>

#include "apps/runtime/clock.h"

namespace palpa::cli {
namespace {

constexpr std::int64_t kLookPeriod = 50 * runtime::kMillisecond;
constexpr int kSignals[] = {SIGINT, SIGTERM};
volatile std::sig_atomic_t interrupted = 0;
struct sigaction old_actions[std::size(kSignals)];

void note(int) { interrupted = 1; }

}  // namespace

InterruptNote::InterruptNote() {
  interrupted = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < std::size(kSignals); ++i)
    sigaction(kSignals[i], &action, &old_actions[i]);
}

InterruptNote::~InterruptNote() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i)
    sigaction(kSignals[i], &old_actions[i], nullptr);
}

bool InterruptNote::noted() const { return interrupted != 0; }

std::int64_t Interrupt::step(std::int64_t now_ns) {
  if (!note_.noted()) return now_ns + kLookPeriod;
  channels_.signals_to_task.push({trial::UserCommand::quit, "Interrupted"});
  return runtime::kNever;
}

}  // namespace palpa::cli
