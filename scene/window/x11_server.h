#pragma once

struct _XDisplay;  // NOLINT(bugprone-reserved-identifier): Xlib's own

namespace palpa::scene {

/// The X server that DISPLAY names, for questions: one connection, kept, since a bare server (Xvfb)
/// resets itself when its last client goes, and refuses the next one while it does. Null: there is
/// none. By one thread at a time.
_XDisplay* xServer();

}  // namespace palpa::scene
