#include "scene/window/gl_context.h"

#include <vtkLogger.h>
#include <vtkOpenGLRenderWindow.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "anatomy/base/error.h"
#include "scene/window/egl_window.h"
#include "scene/window/x11_window.h"

namespace palpa::scene {
namespace {

// GLX and EGL cannot share a process (GLEW's function table belongs to one): the first choice
// stays.
enum class PlatformChoice { undecided, glx, egl };
PlatformChoice process_kind = PlatformChoice::undecided;
GpuChoice chosen_gpu;

std::unique_ptr<GlContextProvider> remember(PlatformChoice kind,
                                            std::unique_ptr<GlContextProvider> made) {
  process_kind = kind;
  return made;
}

/// Without a title none that a person can see.
std::unique_ptr<GlContextProvider> onX11(const WindowPlace& place, const char* title) {
  if (process_kind == PlatformChoice::egl)
    throw Error("this process already draws without a display (EGL)", "X11 window",
                "Open the window in a process of its own");
  if (title && chosen_gpu.card > 0)
    throw UsageError("cannot go with a window, which the X server's card draws", "--gpu",
                     "Leave it out, or add --display offscreen");
  return remember(PlatformChoice::glx, makeX11Window(place, title));
}

std::unique_ptr<GlContextProvider> offscreen(const WindowPlace& place) {
  if (process_kind == PlatformChoice::glx) return onX11(place, nullptr);
  try {
    return remember(PlatformChoice::egl, makeEglWindow(place.width, place.height, chosen_gpu));
  } catch (const Error&) {
    if (process_kind == PlatformChoice::egl || chosen_gpu.card > 0 || !whyNoX11().empty()) throw;
  }
  return onX11(place, nullptr);
}

}  // namespace

void drawBy(const std::string& gpu) {
  chosen_gpu = gpuChoiceOf(gpu, gpus());
  // To Mesa's library, where the X server's card would draw.
  if (!chosen_gpu.automatic && chosen_gpu.card == 0) setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
}

void GlContextProvider::makeCurrent() { window()->MakeCurrent(); }

std::string GlContextProvider::renderer() {
  window()->Render();  // an empty frame: VTK finds OpenGL's functions with the first
  const std::string name = "OpenGL renderer string:";
  std::istringstream said(window()->ReportCapabilities());
  for (std::string line; std::getline(said, line);) {
    if (!line.starts_with(name)) continue;
    const std::size_t first = line.find_first_not_of(' ', name.size());
    return first == std::string::npos ? "" : line.substr(first);
  }
  return "";
}

bool drawsOnProcessor(const std::string& renderer) {
  return renderer.find("llvmpipe") != std::string::npos || renderer.starts_with("softpipe") ||
         renderer.find("Software Rasterizer") != std::string::npos;
}

bool affordsCreases(const std::string& renderer) {
  return !renderer.empty() && !drawsOnProcessor(renderer);
}

void GlContextProvider::neverWait() {
  static_cast<vtkOpenGLRenderWindow*>(window())->SetSwapControl(0);
}

std::unique_ptr<GlContextProvider> makeGlContext(Display display, int width, int height,
                                                 const char* title) {
  return makeGlContext(display, WindowPlace{width, height, false, ""}, title);
}

std::unique_ptr<GlContextProvider> makeGlContext(Display display, const WindowPlace& place,
                                                 const char* title) {
  if (place.width < 1 || place.height < 1)
    throw UsageError("a window needs a width and a height of at least 1 pixel", "window size",
                     "Give for example 1280x720");
  // From 9.3 on VTK writes there what it does, between the program's own lines.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_ERROR);
  const bool can_show = process_kind != PlatformChoice::egl && whyNoX11().empty();
  if (display == Display::window || (display == Display::automatic && can_show))
    return onX11(place, title);
  return offscreen(place);
}

}  // namespace palpa::scene
