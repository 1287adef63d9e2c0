#include "scene/window/egl_window.h"

#include <EGL/egl.h>
#include <dlfcn.h>

#include <map>
#include <mutex>
// X11's headers define macros with everyday names: after all others.
#include <X11/Xlib.h>

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

/// Once a window is destroyed, Xlib says no and leaves the answer as it was: VTK (9.1, at every
/// frame) and Mesa (22.3, when it shows one) take for a size what lies on their stack, and draw
/// into textures of two thousand million pixels or over their own stack. The program therefore
/// stands between: a window that is gone has the size that it had.
namespace {

struct WindowSize {
  int width = 1, height = 1;
};

/// Never destroyed: Mesa's own end, and a thread that was left behind, ask after everything else.
struct WindowSizes {
  std::mutex mutex;
  std::map<XID, WindowSize> all;
};
WindowSizes& sizes() {
  static auto& kept = *new WindowSizes;
  return kept;
}

void keep(XID window, WindowSize size) {
  const std::lock_guard lock(sizes().mutex);
  sizes().all[window] = size;
}

WindowSize kept(XID window) {
  const std::lock_guard lock(sizes().mutex);
  const auto found = sizes().all.find(window);
  return found == sizes().all.end() ? WindowSize{} : found->second;
}

template <class Function>
Function* ofXlib(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) Status XGetWindowAttributes(Display* display, Window window,
                                                                   XWindowAttributes* answer) {
  static auto* const real = ofXlib<decltype(XGetWindowAttributes)>("XGetWindowAttributes");
  const Status known = real(display, window, answer);
  if (known) {
    keep(window, {answer->width, answer->height});
    return known;
  }
  const WindowSize size = kept(window);
  *answer = {};
  answer->width = size.width;
  answer->height = size.height;
  return known;
}

__attribute__((visibility("default"))) Status XGetGeometry(Display* display, Drawable drawable,
                                                           Window* root, int* x, int* y,
                                                           unsigned* width, unsigned* height,
                                                           unsigned* border, unsigned* depth) {
  static auto* const real = ofXlib<decltype(XGetGeometry)>("XGetGeometry");
  const Status known = real(display, drawable, root, x, y, width, height, border, depth);
  if (known) {
    keep(drawable, {static_cast<int>(*width), static_cast<int>(*height)});
    return known;
  }
  const WindowSize size = kept(drawable);
  *x = *y = 0;
  *width = static_cast<unsigned>(size.width);
  *height = static_cast<unsigned>(size.height);
  *root = 0;
  *border = *depth = 0;
  return known;
}
}
