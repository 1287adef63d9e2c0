#include "apps/session/terminal.h"

#include <cstdio>
#include <utility>

#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"

namespace palpa::session {
namespace {
constexpr std::int64_t kStep = 250'000'000;      // session time between looks
constexpr std::int64_t kTerminal = 200'000'000;  // wall time between lines
constexpr std::int64_t kPlain = 5'000'000'000;
}  // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(os::errorsGoToTerminal()) {}

ProgressLine::~ProgressLine() {
  if (!quiet_ && terminal_) std::fputs("\r\033[K", stderr);
}

std::int64_t ProgressLine::step(std::int64_t now_ns) {
  const std::int64_t wall = wall_.now();
  if (!quiet_ && wall - last_wall_ns_ >= (terminal_ ? kTerminal : kPlain)) {
    last_wall_ns_ = wall;
    std::fprintf(stderr, terminal_ ? "\rsession time %.0f s \033[K" : "session time %.0f s\n",
                 static_cast<double>(now_ns) * 1e-9);
    std::fflush(stderr);
  }
  return now_ns + kStep;
}

namespace {

constexpr std::int64_t kRenewed_ns = 200'000'000, kALine_ns = 5'000'000'000,
                       kEstimate_ns = 2'000'000'000;  // before that nobody knows how long it takes
constexpr int kBar = 30;                              // letters

std::string timeLeft(double seconds) {
  const auto whole = static_cast<long long>(seconds);
  if (whole < 60) return std::to_string(whole) + " s";
  const long long minutes = whole / 60;
  if (minutes < 60) return std::to_string(minutes) + " min";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

}  // namespace

WorkProgress::WorkProgress(std::string what, int of, bool quiet)
    : what_(std::move(what)), of_(of), quiet_(quiet), terminal_(os::errorsGoToTerminal()) {}

WorkProgress::~WorkProgress() {
  if (!quiet_ && terminal_) std::fputs("\r\033[K", stderr);
}

std::string WorkProgress::left(int count, std::int64_t now_ns) {
  if (first_count_ < 0) {
    first_count_ = count;
    first_ns_ = now_ns;
  }
  const std::int64_t since = now_ns - first_ns_;
  if (since < kEstimate_ns || count <= first_count_ || count >= of_) return "";
  const double each_ns = static_cast<double>(since) / (count - first_count_);
  return ", about " + timeLeft(1e-9 * each_ns * (of_ - count)) + " left";
}

void WorkProgress::done(int count) {
  const std::int64_t now_ns = clock_.now();
  const std::string more = left(count, now_ns);
  if (quiet_ || now_ns - last_ns_ < (terminal_ ? kRenewed_ns : kALine_ns)) return;
  last_ns_ = now_ns;
  const int full = of_ > 0 ? kBar * count / of_ : kBar;
  const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                          std::string(static_cast<std::size_t>(kBar - full), '.');
  std::fprintf(stderr, terminal_ ? "\r[%s] %d of %d %s%s\033[K" : "[%s] %d of %d %s%s\n",
               bar.c_str(), count, of_, what_.c_str(), more.c_str());
  std::fflush(stderr);
}

}  // namespace palpa::session
