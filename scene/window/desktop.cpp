#include "scene/window/desktop.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <utility>

#include "anatomy/base/error.h"
#include "scene/window/x11_server.h"
// X11's headers define macros with everyday names: after all others.
#include <X11/Xatom.h>
#include <X11/Xutil.h>
#include <X11/extensions/Xrandr.h>

namespace palpa::scene {
namespace {

constexpr int kShareNumerator = 4, kShareDenominator = 5;  // of the monitor, unless asked
constexpr int kSmallestWide = 640, kSmallestHigh = 360;
constexpr double kUsualDpi = 96, kLargestScale = 4;
constexpr long kRemove = 0, kAdd = 1;  // of a window manager's state

struct XFreeing {
  void operator()(void* memory) const { XFree(memory); }
};
struct MonitorsFreeing {
  void operator()(XRRMonitorInfo* all) const { XRRFreeMonitors(all); }
};

Atom atom(::Display* display, const char* name) { return XInternAtom(display, name, False); }

std::string nameOf(::Display* display, Atom name) {
  const std::unique_ptr<char, XFreeing> text(XGetAtomName(display, name));
  return text ? text.get() : "";
}

/// The list of atoms that a window has under this name.
std::vector<Atom> atomsOf(::Display* display, ::Window window, const char* property) {
  constexpr long kMost = 1024;
  Atom type = 0;
  int format = 0;
  unsigned long count = 0, left = 0;
  unsigned char* found = nullptr;
  if (XGetWindowProperty(display, window, atom(display, property), 0, kMost, False, XA_ATOM, &type,
                         &format, &count, &left, &found) != Success)
    return {};
  const std::unique_ptr<unsigned char, XFreeing> owned(found);
  if (type != XA_ATOM || format != 32) return {};
  const auto* const first = reinterpret_cast<const Atom*>(found);
  return {first, first + count};
}

bool contains(const std::vector<Atom>& all, Atom one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Whether somebody manages windows here who knows of full screens.
bool isManaged(::Display* display) {
  return contains(atomsOf(display, DefaultRootWindow(display), "_NET_SUPPORTED"),
                  atom(display, "_NET_WM_STATE_FULLSCREEN"));
}

void askManager(::Display* display, ::Window window, long what) {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = atom(display, "_NET_WM_STATE");
  event.xclient.format = 32;
  event.xclient.data.l[0] = what;
  event.xclient.data.l[1] = static_cast<long>(atom(display, "_NET_WM_STATE_FULLSCREEN"));
  event.xclient.data.l[3] = 1;  // from a program, not from a pager
  XSendEvent(display, DefaultRootWindow(display), False,
             SubstructureNotifyMask | SubstructureRedirectMask, &event);
}

struct Frame {
  int x = 0, y = 0, width = 0, height = 0;
};

Frame frameOf(::Display* display, ::Window window) {
  XWindowAttributes now{};
  Frame frame;
  ::Window ignored = 0;
  if (!XGetWindowAttributes(display, window, &now)) return frame;
  XTranslateCoordinates(display, window, DefaultRootWindow(display), 0, 0, &frame.x, &frame.y,
                        &ignored);
  frame.width = now.width;
  frame.height = now.height;
  return frame;
}

/// Of RandR since 1.5; an older server ends programs that ask.
bool knowsMonitors(::Display* display) {
  int events = 0, errors = 0, major = 0, minor = 0;
  return XRRQueryExtension(display, &events, &errors) && XRRQueryVersion(display, &major, &minor) &&
         std::pair(major, minor) >= std::pair(1, 5);
}

std::string listed(const std::vector<Monitor>& all) {
  std::string words;
  for (std::size_t i = 0; i < all.size(); ++i)
    words += (i > 0 ? ", " : "") + std::to_string(i + 1) + " (" + all[i].name + ", " +
             std::to_string(all[i].width) + "x" + std::to_string(all[i].height) + ")";
  return words;
}

}  // namespace

std::vector<Monitor> monitors() {
  ::Display* const display = xServer();
  if (display == nullptr) return {};
  int count = 0;
  const std::unique_ptr<XRRMonitorInfo, MonitorsFreeing> found(
      knowsMonitors(display) ? XRRGetMonitors(display, DefaultRootWindow(display), True, &count)
                             : nullptr);
  std::vector<Monitor> all;
  for (int i = 0; i < count; ++i) {
    const XRRMonitorInfo& one = found.get()[i];
    all.push_back(
        {nameOf(display, one.name), one.x, one.y, one.width, one.height, one.primary != 0});
  }
  if (all.empty()) {  // a server that knows of no monitors has one screen
    const int screen = DefaultScreen(display);
    all.push_back(
        {"screen", 0, 0, DisplayWidth(display, screen), DisplayHeight(display, screen), true});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Monitor& a, const Monitor& b) { return a.x < b.x; });
  return all;
}

const Monitor& monitorOf(const std::string& word, const std::vector<Monitor>& all) {
  if (all.empty())
    throw UsageError("has no monitor", "the display", "Start the program on a desktop");
  for (std::size_t i = 0; i < all.size(); ++i)
    if (word.empty() ? all[i].primary : word == all[i].name || word == std::to_string(i + 1))
      return all[i];
  if (word.empty()) return all.front();
  throw UsageError("is none of the monitors here", "--monitor " + word,
                   "Give one of these, by number or name: " + listed(all));
}

WindowPlace fittedTo(const Monitor& monitor, WindowPlace wish) {
  const auto fit = [](int wanted, int has, int least) {
    const int usual = std::max(least, has * kShareNumerator / kShareDenominator);
    return std::min(wanted > 0 ? wanted : usual, has);
  };
  wish.width = fit(wish.width, monitor.width, kSmallestWide);
  wish.height = fit(wish.height, monitor.height, kSmallestHigh);
  wish.monitor = monitor.name;
  return wish;
}

double textScale() {
  ::Display* const display = xServer();
  const char* const dpi = display ? XGetDefault(display, "Xft", "dpi") : nullptr;
  const double said = dpi ? std::strtod(dpi, nullptr) : 0;
  return said > 0 ? std::clamp(said / kUsualDpi, 1.0, kLargestScale) : 1;
}

void DesktopWindow::belongTo(const char* program) const {
  ::Display* const display = xServer();
  if (display == nullptr) return;
  std::string name(program);
  XClassHint hint{name.data(), name.data()};
  XSetClassHint(display, number, &hint);
  XFlush(display);
}

void DesktopWindow::fill(bool full, const WindowPlace& back) const {
  ::Display* const display = xServer();
  if (display == nullptr) return;
  if (isManaged(display)) {
    askManager(display, number, full ? kAdd : kRemove);
  } else {
    const Monitor on = monitor();
    const auto width = static_cast<unsigned>(full ? on.width : back.width),
               height = static_cast<unsigned>(full ? on.height : back.height);
    XMoveResizeWindow(display, number, full ? on.x : on.x + (on.width - back.width) / 2,
                      full ? on.y : on.y + (on.height - back.height) / 2, width, height);
  }
  XSync(display, False);
}

bool DesktopWindow::fills() const {
  ::Display* const display = xServer();
  if (display == nullptr) return false;
  if (isManaged(display))
    return contains(atomsOf(display, number, "_NET_WM_STATE"),
                    atom(display, "_NET_WM_STATE_FULLSCREEN"));
  const Frame frame = frameOf(display, number);
  const Monitor on = monitor();
  return frame.width == on.width && frame.height == on.height;
}

Monitor DesktopWindow::monitor() const {
  const std::vector<Monitor> all = monitors();
  if (all.empty()) return {};
  const Frame frame = frameOf(xServer(), number);
  const int x = frame.x + frame.width / 2, y = frame.y + frame.height / 2;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Monitor& one) {
    return x >= one.x && x < one.x + one.width && y >= one.y && y < one.y + one.height;
  });
  return found == all.end() ? monitorOf("", all) : *found;
}

}  // namespace palpa::scene
