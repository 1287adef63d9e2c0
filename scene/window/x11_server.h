#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>

struct _XDisplay;  // NOLINT(bugprone-reserved-identifier): Xlib's own

namespace palpa::scene {

/// The X server that DISPLAY names, for questions: one connection, kept, since a bare server (Xvfb)
/// resets itself when its last client goes, and refuses the next one while it does. Null: there is
/// none. By one thread at a time.
_XDisplay* xServer();

inline constexpr std::uint8_t kFromAnotherProgram = 0x80;  ///< bit of an X event's type

/// xcb's answers and events are the caller's to free.
template <class T>
using XcbAnswer = std::unique_ptr<T, decltype([](T* answer) { std::free(answer); })>;

}  // namespace palpa::scene
