#pragma once

#include <string>
#include <vector>

namespace palpa::scene {

/// Of an X server, in its pixels.
struct Monitor {
  std::string name;  ///< as the server calls it: "HDMI-1"
  int x = 0, y = 0, width = 0, height = 0;
  bool primary = false;
};

/// Those of the server that DISPLAY names, from left to right; none where there is no server.
std::vector<Monitor> monitors();

/// The one of this name, or of this number counted from the left, from 1; for an empty word the
/// primary one. Throws UsageError, which lists those that there are.
const Monitor& monitorOf(const std::string& word, const std::vector<Monitor>& all);

/// Where a window stands, or is to stand.
struct WindowPlace {
  int width = 0, height = 0;  ///< pixels, out of full screen; 0: four fifths of the monitor
  bool full_screen = false;
  std::string monitor;  ///< as monitorOf knows it
};

/// As large as it was asked for, and no larger than the monitor.
WindowPlace fittedTo(const Monitor& monitor, WindowPlace wish);

/// How large text is on this desktop, as its settings say: Xft.dpi / 96, from 1 to 4.
double textScale();

/// A window of an X server, moved about past whoever draws into it. All do nothing where it is
/// gone.
struct DesktopWindow {
  unsigned long number = 0;

  /// The desktop's name for what it belongs to (WM_CLASS): its icon and its group of windows.
  void belongTo(const char* program) const;
  /// Over the whole monitor on which it is, or back. Where no window manager knows of that, by its
  /// size; `back`: where it was.
  void fill(bool full, const WindowPlace& back) const;
  bool fills() const;
  Monitor monitor() const;  ///< on which its middle is
};

}  // namespace palpa::scene
