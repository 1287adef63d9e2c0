#include "scene/egl_window.h"

#include <GL/gl.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>
#include <vtkSmartPointer.h>

#include "anatomy/geometry/error.h"
#include "scene/egl_context.h"
#include "scene/glew_without_glx.h"

namespace palpa::scene {
namespace {

class EglWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static EglWindow* New();
  vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow);

  void setContext(const EglContext* context) { context_ = context; }
  void MakeCurrent() override {
    if (context_ && !context_->isCurrent()) context_->makeCurrent();
  }
  bool IsCurrent() override { return context_ && context_->isCurrent(); }
  // The generic window leaves OpenGL's GL_LESS, with which text is lost on the plate behind it
  // (both lie on the near plane); VTK's own windows use GL_LEQUAL.
  void Start() override {
    Superclass::Start();
    GetState()->vtkglDepthFunc(GL_LEQUAL);
  }

 private:
  const EglContext* context_ = nullptr;
};
vtkStandardNewMacro(EglWindow);

class EglProvider : public GlContextProvider {
 public:
  EglProvider(int width, int height) {
    window_->setContext(&context_);
    window_->SetOwnContext(0);
    window_->SetSupportsOpenGL(1);
    window_->SetIsDirect(1);
    window_->SetMapped(0);
    window_->SetShowWindow(false);
    window_->SetUseOffScreenBuffers(true);
    window_->SetFrameBlitModeToNoBlit();  // there is no default framebuffer to copy to
    window_->SetMultiSamples(0);          // multisampling drops translucent actors here
    window_->SetSwapBuffers(0);
    window_->SetSize(width, height);
    window_->SetReadyForRendering(true);
  }
  ~EglProvider() override {
    context_.makeCurrent();
    window_->Finalize();
    window_ = nullptr;  // before its context goes
  }

  vtkRenderWindow* window() override { return window_; }
  bool interactive() const override { return false; }
  const char* describe() const override { return context_.name().c_str(); }
  NativeContext native() override {
    makeCurrent();
    return context_.native();
  }

 private:
  EglContext context_;
  vtkSmartPointer<EglWindow> window_ = vtkSmartPointer<EglWindow>::New();
};

}  // namespace

std::unique_ptr<GlContextProvider> makeEglWindow(int width, int height) {
  if (!glewInitIsOurs())
    throw Error("the program hides the glewInit of palpa_scene", "EGL",
                "Link the CMake target palpa_scene with its link options");
  return std::make_unique<EglProvider>(width, height);
}

}  // namespace palpa::scene
