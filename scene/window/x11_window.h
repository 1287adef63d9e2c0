#pragma once

#include <memory>
#include <string>

#include "scene/window/gl_context.h"

namespace palpa::scene {

/// Empty when DISPLAY names an X server that offers OpenGL, else why not, in words. VTK ends the
/// process when it meets no X server, so this is asked first.
std::string whyNoX11();

/// A window that a person can see, or (`visible` false) GLX drawing without one. Throws Error.
std::unique_ptr<GlContextProvider> makeX11Window(int width, int height, const char* title,
                                                 bool visible);

}  // namespace palpa::scene
