#include "apps/cli/progress.h"

#include <unistd.h>

#include <cstdio>

namespace palpa::cli {
namespace {
constexpr std::int64_t kStep = 250'000'000;      // session time between looks
constexpr std::int64_t kTerminal = 200'000'000;  // wall time between lines
constexpr std::int64_t kPlain = 5'000'000'000;
}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (!quiet_ && terminal_) std::fputs("\r\033[K", stderr);
}

std::int64_t Progress::step(std::int64_t now_ns) {
  const std::int64_t wall = wall_.now();
  if (!quiet_ && wall - last_wall_ns_ >= (terminal_ ? kTerminal : kPlain)) {
    last_wall_ns_ = wall;
    std::fprintf(stderr, terminal_ ? "\rsession time %.0f s \033[K" : "session time %.0f s\n",
                 static_cast<double>(now_ns) * 1e-9);
    std::fflush(stderr);
  }
  return now_ns + kStep;
}

}  // namespace palpa::cli
