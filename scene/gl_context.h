#pragma once

#include <memory>

class vtkRenderWindow;

namespace palpa::scene {

enum class Display { automatic, window, offscreen };

/// Owns the one OpenGL context kind of the process (GLX or surfaceless EGL; never both) and makes
/// VTK render windows on it. Throws Error when the wanted kind is not to be had.
class GlContextProvider {
 public:
  virtual ~GlContextProvider() = default;
  virtual vtkRenderWindow* window() = 0;     ///< owned by the provider
  virtual bool interactive() const = 0;      ///< a window a person can see
  virtual const char* describe() const = 0;  ///< "X11 window", "surfaceless EGL", ...
};
std::unique_ptr<GlContextProvider> makeGlContext(Display display, int width, int height,
                                                 const char* title);

}  // namespace palpa::scene
