#include <X11/Xlib.h>
#include <dlfcn.h>

#include <map>
#include <mutex>

/// Once a window is destroyed, Xlib says no and leaves the answer as it was: VTK (9.1, at every
/// frame) and Mesa (22.3, when it shows one) take for a size what lies on their stack, and draw
/// into textures of two thousand million pixels or over their own stack. The program therefore
/// stands between: a window that is gone has the size that it had.
namespace {

struct WindowSize {
  int width = 1, height = 1;
};

std::mutex sizes_mutex;
std::map<XID, WindowSize> sizes;

void keep(XID window, WindowSize size) {
  const std::lock_guard lock(sizes_mutex);
  sizes[window] = size;
}

WindowSize kept(XID window) {
  const std::lock_guard lock(sizes_mutex);
  const auto found = sizes.find(window);
  return found == sizes.end() ? WindowSize{} : found->second;
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
