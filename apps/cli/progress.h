#pragma once

#include "apps/runtime/activity.h"
#include "apps/runtime/clock.h"

namespace palpa::cli {

/// Says on standard error how a session goes: a line that renews itself on a terminal, a line every
/// five seconds otherwise.
class Progress final : public runtime::Activity {
 public:
  explicit Progress(bool quiet);
  ~Progress() override;
  const char* name() const override { return "progress"; }
  std::int64_t step(std::int64_t now_ns) override;

 private:
  bool quiet_, terminal_;
  std::int64_t last_wall_ns_ = 0;
  runtime::SteadyClock wall_;
};

}  // namespace palpa::cli
