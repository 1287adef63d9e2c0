#pragma once

#include <memory>
#include <string>

#include "scene/window/egl_devices.h"
#include "scene/window/gl_context.h"

namespace palpa::scene {

/// A desktop OpenGL (core, 3.2 or later) context without any surface or window system. Unless one
/// is chosen, looks in this order: EGL devices with hardware behind them, Mesa's surfaceless
/// platform, Mesa's software device. Throws Error when none gives a context.
class EglContext {
 public:
  explicit EglContext(const GpuChoice& choice = {});
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent() const;  ///< in the calling thread; throws Error
  bool isCurrent() const;
  NativeContext native() const;
  const std::string& name() const { return name_; }  ///< "surfaceless EGL" or "EGL device"

 private:
  bool open(void* display, const char* name);

  void* display_ = nullptr;  // EGLDisplay; stays initialised: others in the process may share it
  void *config_ = nullptr, *context_ = nullptr;  // EGLConfig, EGLContext
  std::string name_;
};

/// Pictures without a display: a VTK window that draws into its own buffers on an EglContext.
/// Throws Error when the machine has no EGL, or the program does not export our glewInit.
std::unique_ptr<GlContextProvider> makeEglWindow(int width, int height,
                                                 const GpuChoice& choice = {});

}  // namespace palpa::scene

/// VTK starts GLEW, and GLEW asks GLX for a display after it has loaded every OpenGL entry point.
/// On an EGL context that last question fails (GLEW_ERROR_NO_GLX_DISPLAY, 4) and VTK gives up,
/// although OpenGL is ready. This object therefore defines glewInit itself: it calls GLEW's and
/// forgives that one answer while an EGL context is current. The program must export the symbol;
/// palpa_scene's link options see to it.
namespace palpa::scene {

/// True when this process's shared libraries really resolve glewInit to ours. Without that, an EGL
/// window would end in an obscure VTK message: ask first.
bool glewInitIsOurs();

}  // namespace palpa::scene
