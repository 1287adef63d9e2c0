#include "apps/runtime/device_activity.h"

namespace palpa::runtime {

std::int64_t DriverActivity::step(std::int64_t now_ns) {
  if (!opened_) driver_.open();
  opened_ = true;
  const std::int64_t due_ns = driver_.step(now_ns);
  const haptics::DriverStatus status = driver_.status();
  may_push_.store(status.state == haptics::DriverState::ready);
  if (status.state != reported_.state || status.problem != reported_.problem) {
    reported_ = status;
    notices_.push({now_ns, 0, nameOf(EventKind::device), driver_.words(status), 0});
  }
  return due_ns;
}

void DriverActivity::end() noexcept {
  driver_.close();
  opened_ = false;
}

}  // namespace palpa::runtime
