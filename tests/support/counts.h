#pragma once

#include <cstdlib>
#include <string_view>

namespace palpa::test {

/// Whether every stated count is asked for (`./check --full`).
inline bool fullCounts() {
  const char* full = std::getenv("PALPA_FULL");
  return full && std::string_view(full) == "1";
}

template <class Count>
Count counted(Count few, Count full) {
  return fullCounts() ? full : few;
}

/// Whether a sanitizer looks on.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace palpa::test
