#pragma once

#include "apps/runtime/activity.h"
#include "apps/trial/trial_status.h"

namespace palpa::cli {

/// While it lives, the first Ctrl-C or SIGTERM is noted instead of ending the program; a second one
/// kills. One at a time; the old handlers come back at its end.
class InterruptNote {
 public:
  InterruptNote();
  ~InterruptNote();
  InterruptNote(const InterruptNote&) = delete;
  InterruptNote& operator=(const InterruptNote&) = delete;
  bool noted() const;
};

/// Ctrl-C and SIGTERM close a session as Escape does: the trial is ended, devices get zero force,
/// files are written.
class Interrupt final : public runtime::Activity {
 public:
  explicit Interrupt(trial::Channels& channels) : channels_(channels) {}
  const char* name() const override { return "interrupt"; }
  std::int64_t step(std::int64_t now_ns) override;

 private:
  trial::Channels& channels_;
  InterruptNote note_;
};

}  // namespace palpa::cli
