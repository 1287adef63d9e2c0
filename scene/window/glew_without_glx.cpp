#include "scene/window/egl_window.h"

#include <EGL/egl.h>
#include <dlfcn.h>

namespace {

constexpr unsigned kGlewOk = 0;
constexpr unsigned kNoGlewFound = 1;
constexpr unsigned kGlewNoGlxDisplay = 4;  // GLEW_ERROR_NO_GLX_DISPLAY in GL/glew.h

using GlewInit = unsigned (*)();

}  // namespace

extern "C" __attribute__((visibility("default"))) unsigned glewInit() {
  const auto next = reinterpret_cast<GlewInit>(dlsym(RTLD_NEXT, "glewInit"));
  if (next == nullptr) return kNoGlewFound;
  const unsigned answer = next();
  const bool on_egl = eglGetCurrentContext() != EGL_NO_CONTEXT;
  return answer == kGlewNoGlxDisplay && on_egl ? kGlewOk : answer;
}

namespace palpa::scene {

bool glewInitIsOurs() {
  return dlsym(RTLD_DEFAULT, "glewInit") == reinterpret_cast<void*>(&glewInit);
}

}  // namespace palpa::scene
