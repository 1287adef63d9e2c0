#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/os/child_process.h"
#include "apps/runtime/activity.h"
#include "haptics/devices/driver.h"

namespace palpa::session {

/// A device whose own watchdog nobody vouches for may keep its last force when this program dies
/// or is stopped. So another process of this program stands beside the session, holds the other
/// end of a line, and takes the force away then. In the session: starts it, sends it a sign of life
/// every 50 ms, and a farewell when the session ends in order.
class ForceGuard final : public runtime::Activity {
 public:
  /// For that device, as the station's file describes it. Without a process to be had, or in
  /// another program than `palpa`, none stands.
  ForceGuard(const haptics::DriverDescription& device, const haptics::DriverSettings& settings);
  ~ForceGuard() override;
  ForceGuard(const ForceGuard&) = delete;
  ForceGuard& operator=(const ForceGuard&) = delete;

  const char* name() const override { return "force guard"; }
  std::int64_t step(std::int64_t now_ns) override;
  bool stands() const;

 private:
  os::Companion guard_;
};

/// How a guard's watch ended.
enum class GuardWatch : std::uint8_t {
  dismissed,  ///< the session took leave
  dead,       ///< its end of the line is gone, and no farewell came
  stopped     ///< it was stopped, and has been ended by the guard
};
/// Watches over `session` at its line; waits as long as that lasts. A session that is only silent
/// goes on: its driver commands zero by itself.
GuardWatch watchSession(int line, const os::ProcessId& session);

/// Opens a device that nobody holds any more, which is zero force from the first exchange on; up to
/// 3 s. False: it does not answer.
bool takeForceAway(haptics::Driver& driver);

/// The guard's whole life, where `words` are those of a guard: `palpa force-guard NUMBER BEGAN
/// DRIVER [FIELD=VALUE...]`, started by a session alone.
bool isGuard(const std::vector<std::string>& words);
int standGuard(const std::vector<std::string>& words);

}  // namespace palpa::session
