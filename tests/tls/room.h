#pragma once

#include "apps/os/tls/certificates.h"

/// A room's authority, and the day on which everything here happens.
namespace palpa::os {

inline constexpr std::chrono::sys_seconds kNow =
    std::chrono::sys_days{std::chrono::year{2026} / 3 / 1};

inline const Identity& authority() {
  static const Identity made =
      makeAuthority("Authority of a room", {}, std::chrono::days{3650}, kNow);
  return made;
}

}  // namespace palpa::os
