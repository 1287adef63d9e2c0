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

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// Of simulated time, where a sanitizer looks on: many times as slow, and what it looks for shows
/// in the few. All of them run without it.
template <class Count>
Count countedUnlessSanitized(Count few, Count full) {
  return kSanitized ? few : counted(few, full);
}

}  // namespace palpa::test
