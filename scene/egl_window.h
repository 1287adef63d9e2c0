#pragma once

#include <memory>

#include "scene/gl_context.h"

namespace palpa::scene {

/// Pictures without a display: a VTK window that draws into its own buffers on an EglContext.
/// Throws Error when the machine has no EGL, or the program does not export our glewInit.
std::unique_ptr<GlContextProvider> makeEglWindow(int width, int height);

}  // namespace palpa::scene
