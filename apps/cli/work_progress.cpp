#include "apps/cli/work_progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace palpa::cli {
namespace {

constexpr std::int64_t kRenewed_ns = 200'000'000, kALine_ns = 5'000'000'000;
constexpr int kBar = 30;  // letters

}  // namespace

WorkProgress::WorkProgress(std::string what, int of)
    : what_(std::move(what)), of_(of), terminal_(isatty(STDERR_FILENO) != 0) {}

WorkProgress::~WorkProgress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void WorkProgress::done(int count) {
  const std::int64_t now_ns = clock_.now();
  if (now_ns - last_ns_ < (terminal_ ? kRenewed_ns : kALine_ns)) return;
  last_ns_ = now_ns;
  const int full = of_ > 0 ? kBar * count / of_ : kBar;
  const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                          std::string(static_cast<std::size_t>(kBar - full), '.');
  std::fprintf(stderr, terminal_ ? "\r[%s] %d of %d %s\033[K" : "[%s] %d of %d %s\n", bar.c_str(),
               count, of_, what_.c_str());
  std::fflush(stderr);
}

}  // namespace palpa::cli
