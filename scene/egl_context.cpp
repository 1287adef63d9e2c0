#include "scene/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <vector>

#include "anatomy/geometry/error.h"

namespace palpa::scene {
namespace {

struct Candidate {
  EGLDisplay display;
  const char* name;
};

bool has(const char* extensions, const char* wanted) {
  return extensions != nullptr && std::strstr(extensions, wanted) != nullptr;
}

template <class Function>
Function entry(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

EGLDisplay platformDisplay(EGLenum platform, void* native) {
  static const auto get = entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  return get ? get(platform, native, nullptr) : EGL_NO_DISPLAY;
}

std::vector<EGLDeviceEXT> devices(bool software) {
  const auto list = entry<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto describe = entry<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  EGLDeviceEXT found[16];
  EGLint count = 0;
  if (!list || !describe || !list(16, found, &count)) return {};
  std::vector<EGLDeviceEXT> result;
  for (EGLint i = 0; i < count; ++i) {
    if (has(describe(found[i], EGL_EXTENSIONS), "EGL_MESA_device_software") == software)
      result.push_back(found[i]);
  }
  return result;
}

std::vector<Candidate> candidates() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool by_device = has(client, "EGL_EXT_platform_device");
  std::vector<Candidate> result;
  const auto addDevices = [&](bool software) {
    if (!by_device) return;
    for (EGLDeviceEXT device : devices(software))
      result.push_back({platformDisplay(EGL_PLATFORM_DEVICE_EXT, device), "EGL device"});
  };
  addDevices(false);
  if (has(client, "EGL_MESA_platform_surfaceless")) {
    result.push_back(
        {platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY), "surfaceless EGL"});
  }
  addDevices(true);
  return result;
}

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

EglContext::EglContext() {
  for (const Candidate& candidate : candidates()) {
    if (open(candidate.display, candidate.name)) return;
  }
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

}  // namespace palpa::scene
