#pragma once

#include <cstdint>

namespace palpa::os {

/// The computer's clocks, in nanoseconds. Only apps/runtime/clock asks what time it is: everybody
/// else asks it. What the processor's time went to is for measurements. None of them allocates,
/// locks or throws.
std::int64_t monotonic_ns() noexcept;  ///< CLOCK_MONOTONIC: never set, begins anywhere
std::int64_t date_ns() noexcept;       ///< since 1970 (UTC); somebody may set it at any moment
std::int64_t monotonicResolution_ns() noexcept;
std::int64_t
threadsProcessorTime_ns() noexcept;        ///< CLOCK_THREAD_CPUTIME_ID: of the calling thread
std::int64_t processorTime_ns() noexcept;  ///< of this process, from its beginning
/// The calling thread sleeps until CLOCK_MONOTONIC shows this, however often a signal wakes it.
void sleepUntilMonotonic(std::int64_t t_ns) noexcept;

/// A time server keeps the computer's date.
bool dateIsKept() noexcept;

}  // namespace palpa::os
