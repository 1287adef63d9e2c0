#include "scene/window/egl_window.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>
#include <vtkSmartPointer.h>

#include <EGL/egl.h>
#include <GL/gl.h>

#include "anatomy/base/error.h"

namespace palpa::scene {
namespace {

EGLContext createContext(EGLDisplay display, void** config_out) {
  // The default EGL_SURFACE_TYPE asks for windows, which these platforms do not have.
  const EGLint config_wish[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                EGL_OPENGL_BIT, EGL_NONE};
  const EGLint context_wish[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 2,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, config_wish, &config, 1, &count) || count == 0)
    return EGL_NO_CONTEXT;
  *config_out = config;
  return eglCreateContext(display, config, EGL_NO_CONTEXT, context_wish);
}

}  // namespace

EglContext::EglContext(const GpuChoice& choice) {
  for (const EglCandidate& candidate : candidatesFor(choice, gpus()))
    if (open(candidate.display, candidate.name)) return;
  if (choice.card > 0)
    throw Error("gives no OpenGL", "graphics card " + std::to_string(choice.card),
                "Update its driver, or leave out --gpu");
  throw Error("no way to draw without a window was found", "EGL",
              "Install libegl1 and libgl1-mesa-dri, or start the program under xvfb-run");
}

bool EglContext::open(void* display, const char* name) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return false;
  if (!eglBindAPI(EGL_OPENGL_API)) return false;
  const EGLContext context = createContext(display, &config_);
  if (context == EGL_NO_CONTEXT) return false;
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    eglDestroyContext(display, context);
    return false;
  }
  display_ = display;
  context_ = context;
  name_ = name;
  return true;
}

EglContext::~EglContext() {
  if (isCurrent()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void EglContext::makeCurrent() const {
  eglBindAPI(EGL_OPENGL_API);
  if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    throw Error("the OpenGL context cannot be made current", name_,
                "Use the scene from one thread at a time");
}

bool EglContext::isCurrent() const { return eglGetCurrentContext() == context_; }

NativeContext EglContext::native() const {
  NativeContext native;
  native.display = display_;
  native.config = config_;
  native.context = context_;
  native.address = eglGetProcAddress;
  return native;
}

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
  EglProvider(int width, int height, const GpuChoice& choice) : context_(choice) {
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
    try {
      context_.makeCurrent();
      window_->Finalize();
    } catch (const Error&) {  // the context is lost, and all that it held
    }
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

std::unique_ptr<GlContextProvider> makeEglWindow(int width, int height, const GpuChoice& choice) {
  if (!glewInitIsOurs())
    throw Error("the program hides the glewInit of palpa_scene", "EGL",
                "Link the CMake target palpa_scene with its link options");
  return std::make_unique<EglProvider>(width, height, choice);
}

}  // namespace palpa::scene
