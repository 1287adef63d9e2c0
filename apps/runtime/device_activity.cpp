#include "apps/runtime/device_activity.h"

#include <string>

namespace palpa::runtime {
namespace {

using haptics::FalconProblem;
using haptics::FalconState;

/// Empty: all is well.
std::string words(const haptics::FalconStatus& status) {
  if (status.state == FalconState::ready) return "";
  if (status.problem != FalconProblem::none) return haptics::falconError(status.problem).what();
  return haptics::falconInstruction(status.state);
}

}  // namespace

std::int64_t FalconActivity::step(std::int64_t now_ns) {
  if (!opened_) driver_.open();
  opened_ = true;
  const std::int64_t due_ns = driver_.step(now_ns);
  const haptics::FalconStatus status = driver_.status();
  may_push_.store(status.state == FalconState::ready);
  if (status.state != reported_state_ || status.problem != reported_problem_) {
    reported_state_ = status.state;
    reported_problem_ = status.problem;
    notices_.push({now_ns, 0, nameOf(EventKind::device), words(status), 0});
  }
  return due_ns;
}

void FalconActivity::end() noexcept {
  driver_.close();
  opened_ = false;
}

}  // namespace palpa::runtime
