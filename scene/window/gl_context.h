#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scene/window/desktop.h"
#include "scene/window/stop_key.h"

class vtkRenderWindow;

namespace palpa::scene {

/// A context as GLX or EGL have it, for what else wants to draw in it.
struct NativeContext {
  bool glx = false;  ///< otherwise EGL
  void *display = nullptr, *config = nullptr, *context = nullptr;
  unsigned long drawable = 0;                   ///< GLX
  unsigned visual = 0;                          ///< GLX
  void (*(*address)(const char*))() = nullptr;  ///< of OpenGL's functions (EGL)
};

enum class Display { automatic, window, offscreen };

/// Owns the one OpenGL context kind of the process (GLX or surfaceless EGL; never both) and makes
/// VTK render windows on it. Throws Error when the wanted kind is not to be had.
class GlContextProvider {
 public:
  virtual ~GlContextProvider() = default;
  virtual vtkRenderWindow* window() = 0;     ///< owned by the provider
  virtual bool interactive() const = 0;      ///< a window a person can see
  virtual const char* describe() const = 0;  ///< "X11 window", "surfaceless EGL", ...
  virtual NativeContext native() = 0;        ///< and makes it current
  /// Of a window at an X server, which hears its space bar past whoever draws; null: none.
  virtual std::unique_ptr<StopKey> stopKey() { return nullptr; }
  virtual std::optional<WindowPlace> place() { return std::nullopt; }  ///< of a window, as it is
  virtual void setFullScreen(bool) {}                                  ///< does nothing without one
  void makeCurrent();                                                  ///< on the calling thread
  /// What draws, as OpenGL names it: "NVIDIA RTX 4000/PCIe", "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string renderer();
  void neverWait();  ///< frames do not wait for the monitor's
};
/// Whether this renderer is a program that draws on the processor: Mesa's.
bool drawsOnProcessor(const std::string& renderer);
/// Whether there is time for `ViewLayout::creases`: a graphics card draws.
bool affordsCreases(const std::string& renderer);
/// By what is drawn from now on in this process: "auto", "none" (the processor), or the number of a
/// graphics card (gpus()). A card is chosen for what is drawn without a window; a window is drawn
/// by the X server's. Throws UsageError.
void drawBy(const std::string& gpu);

/// Of a window: throws UsageError for a monitor that is not there.
std::unique_ptr<GlContextProvider> makeGlContext(Display display, const WindowPlace& place,
                                                 const char* title);
std::unique_ptr<GlContextProvider> makeGlContext(Display display, int width, int height,
                                                 const char* title);

}  // namespace palpa::scene
