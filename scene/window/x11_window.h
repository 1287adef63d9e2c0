#pragma once

#include <functional>
#include <memory>
#include <string>

#include "scene/window/desktop.h"
#include "scene/window/gl_context.h"

namespace palpa::scene {

/// Empty when DISPLAY names an X server that offers OpenGL, else why not, in words. VTK ends the
/// process when it meets no X server, so this is asked first.
std::string whyNoX11();
/// What helps then.
std::string adviceWithoutX11();
/// A desktop of Wayland's without XWayland beside it: windows are to be had, but not by X11.
bool isWaylandAlone();

/// Calls `lost` once when the server, or the window, is gone: on whichever thread met it. After the
/// window alone that thread goes on; after the server it never comes back, since no call of the
/// window system can be trusted then: somebody else must end the program. Without anybody to tell
/// (null), the program says so and ends at once.
void whenWindowIsLost(std::function<void()> lost);

/// A window that a person can see, there; without a title GLX drawing without one. Throws Error.
std::unique_ptr<GlContextProvider> makeX11Window(const WindowPlace& place, const char* title);

}  // namespace palpa::scene
