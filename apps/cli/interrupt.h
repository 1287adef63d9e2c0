#pragma once

#include "apps/runtime/activity.h"
#include "apps/trial/trial_status.h"

namespace palpa::cli {

/// Ctrl-C and SIGTERM close a session as Escape does: the trial is ended, devices get zero force, files are written. A
/// second one kills. One at a time; the old handlers come back at its end.
class Interrupt final : public runtime::Activity {
 public:
  explicit Interrupt(trial::Channels& channels);
  ~Interrupt() override;
  const char* name() const override { return "interrupt"; }
  std::int64_t step(std::int64_t now_ns) override;

 private:
  trial::Channels& channels_;
};

}  // namespace palpa::cli
