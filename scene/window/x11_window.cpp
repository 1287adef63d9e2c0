#include "scene/window/x11_window.h"

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <cstdio>
#include <cstdlib>
#include <future>
#include <mutex>
#include <utility>

#include "anatomy/base/error.h"
#include "scene/window/x11_server.h"
// X11's headers define macros with everyday names: after all others.
#include <GL/glx.h>

namespace palpa::scene {
namespace {

std::mutex lost_mutex;
std::function<void()> tell_lost;
bool listened_to = false, is_lost = false;

/// False: nobody has wanted to know. Once somebody did, what comes later is no news.
bool tellLost() {
  const std::lock_guard lock(lost_mutex);
  is_lost = is_lost || listened_to;
  if (tell_lost) std::exchange(tell_lost, nullptr)();
  return is_lost;
}

void endWithoutWindow() {
  std::fprintf(stderr,
               "palpa: the window is gone: the X server ended, or another program closed "
               "it. Start again on a display that stays\n");
  std::_Exit(EXIT_FAILURE);
}

/// Another program has destroyed the window, or what is drawn into: what still is drawn goes
/// nowhere. Other errors are of single requests; the window is there.
int noteXError(::Display*, XErrorEvent* error) {
  constexpr int kFirstOfExtensions = 128;  // of GLX: its drawable is gone
  const bool is_gone = error->error_code == BadWindow || error->error_code == BadDrawable ||
                       error->error_code >= kFirstOfExtensions;
  if (is_gone && !tellLost()) endWithoutWindow();
  return 0;
}

/// Xlib ends the program when this returns.
int parkWithoutServer(::Display*) {
  if (!tellLost()) endWithoutWindow();
  std::promise<void>().get_future().wait();
  return 0;
}

class X11Provider : public GlContextProvider {
 public:
  X11Provider(const WindowPlace& place, const char* title)
      : visible_(title != nullptr), place_(place) {
    window_->SetMultiSamples(0);  // multisampling drops translucent actors
    window_->SetSize(place.width, place.height);
    window_->SetDPI(72);  // text sizes are pixels
    XSetErrorHandler(noteXError);
    XSetIOErrorHandler(parkWithoutServer);
    if (visible_)
      open(title);
    else
      window_->SetOffScreenRendering(1);
  }
  ~X11Provider() override { window_->Finalize(); }

  vtkRenderWindow* window() override { return window_; }
  bool interactive() const override { return visible_; }
  const char* describe() const override { return visible_ ? "X11 window" : "offscreen X11"; }
  NativeContext native() override;
  std::unique_ptr<StopKey> stopKey() override;
  std::optional<WindowPlace> place() override;
  void setFullScreen(bool full) override;

 private:
  void open(const char* title);
  DesktopWindow desktop() const {
    return {static_cast<unsigned long>(
        reinterpret_cast<std::uintptr_t>(window_->GetGenericWindowId()))};
  }

  const bool visible_;
  WindowPlace place_;  ///< of a window; its size out of full screen
  vtkSmartPointer<vtkRenderWindow> window_ = vtkSmartPointer<vtkRenderWindow>::New();
};

void X11Provider::open(const char* title) {
  const std::vector<Monitor> all = monitors();
  const Monitor& on = monitorOf(place_.monitor, all);
  window_->SetWindowName(title);
  window_->SetPosition(on.x + (on.width - place_.width) / 2,
                       on.y + (on.height - place_.height) / 2);
  window_->Start();  // makes the window
  desktop().belongTo("palpa");
  if (place_.full_screen) desktop().fill(true, place_);
}

std::optional<WindowPlace> X11Provider::place() {
  if (!visible_) return std::nullopt;
  place_.full_screen = desktop().fills();
  place_.monitor = desktop().monitor().name;
  if (!place_.full_screen) {
    const int* const size = window_->GetSize();
    place_.width = size[0];
    place_.height = size[1];
  }
  return place_;
}

void X11Provider::setFullScreen(bool full) {
  const std::optional<WindowPlace> now = place();
  if (now && now->full_screen != full) desktop().fill(full, *now);
}

/// The GLXFBConfig of this number; VTK keeps it to itself.
GLXFBConfig configOf(::Display* display, int id) {
  const int wish[] = {GLX_FBCONFIG_ID, id, 0};
  int count = 0;
  GLXFBConfig* const found = glXChooseFBConfig(display, DefaultScreen(display), wish, &count);
  const GLXFBConfig config = count > 0 ? found[0] : nullptr;
  if (found) XFree(found);
  return config;
}

NativeContext X11Provider::native() {
  window_->Start();  // makes the context where there is none
  makeCurrent();
  NativeContext native;
  native.glx = true;
  native.display = glXGetCurrentDisplay();
  native.context = glXGetCurrentContext();
  native.drawable = glXGetCurrentDrawable();
  if (native.display == nullptr || native.context == nullptr)
    throw Error("has no OpenGL context", "X11 window", "Update the graphics driver");
  auto* const display = static_cast<::Display*>(native.display);
  int id = 0, visual = 0;
  glXQueryContext(display, static_cast<GLXContext>(native.context), GLX_FBCONFIG_ID, &id);
  native.config = configOf(display, id);
  if (native.config)
    glXGetFBConfigAttrib(display, static_cast<GLXFBConfig>(native.config), GLX_VISUAL_ID, &visual);
  native.visual = static_cast<unsigned>(visual);
  return native;
}

std::unique_ptr<StopKey> X11Provider::stopKey() {
  window_->Start();  // makes the window where there is none
  return std::make_unique<StopKey>(desktop().number);
}

}  // namespace

void whenWindowIsLost(std::function<void()> lost) {
  const std::lock_guard guard(lost_mutex);
  listened_to = lost != nullptr;
  tell_lost = std::move(lost);
}

::Display* xServer() {
  static ::Display* connection = nullptr;
  if (connection == nullptr) connection = XOpenDisplay(nullptr);
  return connection;
}

namespace {

bool isSet(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

bool isWaylandAlone() { return isSet("WAYLAND_DISPLAY") && !isSet("DISPLAY"); }

std::string whyNoX11() {
  if (isWaylandAlone()) return "this desktop is Wayland's, and XWayland is not there";
  if (!isSet("DISPLAY")) return "DISPLAY is not set";
  const std::string named = "the X display " + std::string(std::getenv("DISPLAY"));
  ::Display* const display = xServer();
  if (display == nullptr) return named + " cannot be opened";
  const bool has_glx = glXQueryExtension(display, nullptr, nullptr);
  return has_glx ? "" : named + " offers no OpenGL (GLX)";
}

std::string adviceWithoutX11() {
  return isWaylandAlone() ? "Install the package xwayland and log in again, or use --display "
                            "offscreen"
                          : "Start a desktop session or use --display offscreen";
}

std::unique_ptr<GlContextProvider> makeX11Window(const WindowPlace& place, const char* title) {
  const std::string reason = whyNoX11();
  if (!reason.empty()) throw Error(reason, "X11", adviceWithoutX11());
  return std::make_unique<X11Provider>(place, title);
}

}  // namespace palpa::scene
