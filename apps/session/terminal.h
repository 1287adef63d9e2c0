#pragma once

#include <cstdint>
#include <string>

#include "apps/runtime/activity.h"
#include "apps/runtime/clock.h"

namespace palpa::session {

/// Says on standard error how a session goes: a line that renews itself on a terminal, a line every
/// five seconds otherwise.
class ProgressLine final : public runtime::Activity {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine() override;
  const char* name() const override { return "progress"; }
  std::int64_t step(std::int64_t now_ns) override;

 private:
  bool quiet_, terminal_;
  std::int64_t last_wall_ns_ = 0;
  runtime::SteadyClock wall_;
};

/// How far a piece of work is, and about how long it goes on, on standard error: a line that renews
/// itself on a terminal, a line every five seconds otherwise.
class WorkProgress {
 public:
  WorkProgress(std::string what, int of, bool quiet = false);
  ~WorkProgress();
  WorkProgress(const WorkProgress&) = delete;
  WorkProgress& operator=(const WorkProgress&) = delete;
  void done(int count);  ///< what was done before the first call counts for no speed

 private:
  std::string left(int count, std::int64_t now_ns);

  std::string what_;
  int of_;
  bool quiet_, terminal_;
  int first_count_ = -1;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  runtime::SteadyClock clock_;
};

}  // namespace palpa::session
