#include "ar/headset/xr_runtime.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "anatomy/base/error.h"
// X11's headers define macros with everyday names: after all others.
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr_platform.h>

namespace palpa::ar {
namespace {

template <class Function>
Function entryOf(XrInstance instance, const char* name) {
  PFN_xrVoidFunction function = nullptr;
  xrCheck(xrGetInstanceProcAddr(instance, name, &function), name);
  return reinterpret_cast<Function>(function);
}

/// Of the current context.
void requireVersion(XrVersion least) {
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  const auto words = [](std::uint64_t a, std::uint64_t b) {
    return std::to_string(a) + "." + std::to_string(b);
  };
  if (major == 0) return;  // no context: the runtime says so
  if (XR_MAKE_VERSION(major, minor, 0) >=
      XR_MAKE_VERSION(XR_VERSION_MAJOR(least), XR_VERSION_MINOR(least), 0))
    return;
  throw Error("the headset needs OpenGL " +
                  words(XR_VERSION_MAJOR(least), XR_VERSION_MINOR(least)) +
                  "; the graphics driver gives " +
                  words(static_cast<std::uint64_t>(major), static_cast<std::uint64_t>(minor)),
              "headset", "Update the graphics driver");
}

XrOwnedSession sessionWith(XrInstance instance, XrSystemId system, const void* binding) {
  XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, binding, 0, system};
  XrSession session = XR_NULL_HANDLE;
  xrCheck(xrCreateSession(instance, &info, &session), "xrCreateSession");
  return XrOwnedSession(session);
}

}  // namespace

std::vector<const char*> graphicsExtensions(GlPlatform kind) {
  std::vector<const char*> names{XR_KHR_OPENGL_ENABLE_EXTENSION_NAME};
  if (kind == GlPlatform::egl) names.push_back(XR_MNDX_EGL_ENABLE_EXTENSION_NAME);
  return names;
}

bool takeContext(const GlBinding& gl) {
  if (!gl.context) return true;
  if (gl.kind == GlPlatform::egl)
    return eglBindAPI(EGL_OPENGL_API) &&
           eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, gl.context);
  return glXMakeCurrent(static_cast<Display*>(gl.display), gl.drawable,
                        static_cast<GLXContext>(gl.context));
}

void letGoOfContext(const GlBinding& gl) {
  if (!gl.context) return;
  if (gl.kind == GlPlatform::egl) {
    if (eglGetCurrentContext() == gl.context)
      eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  } else if (glXGetCurrentContext() == gl.context) {
    glXMakeCurrent(static_cast<Display*>(gl.display), None, nullptr);
  }
}

XrOwnedSession makeSession(XrInstance instance, XrSystemId system, const GlBinding& gl) {
  XrGraphicsRequirementsOpenGLKHR needs{XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR, nullptr, 0, 0};
  xrCheck(entryOf<PFN_xrGetOpenGLGraphicsRequirementsKHR>(
              instance, "xrGetOpenGLGraphicsRequirementsKHR")(instance, system, &needs),
          "xrGetOpenGLGraphicsRequirementsKHR");
  requireVersion(needs.minApiVersionSupported);
  if (gl.kind == GlPlatform::egl) {
    XrGraphicsBindingEGLMNDX binding{XR_TYPE_GRAPHICS_BINDING_EGL_MNDX,
                                     nullptr,
                                     reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(gl.address),
                                     gl.display,
                                     gl.config,
                                     gl.context};
    return sessionWith(instance, system, &binding);
  }
  XrGraphicsBindingOpenGLXlibKHR binding{XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR, nullptr,
                                         static_cast<Display*>(gl.display),        gl.visual,
                                         static_cast<GLXFBConfig>(gl.config),      gl.drawable,
                                         static_cast<GLXContext>(gl.context)};
  return sessionWith(instance, system, &binding);
}

std::vector<std::uint32_t> texturesOf(XrSwapchain swapchain) {
  const auto images = xrListed<XrSwapchainImageOpenGLKHR>(
      [&](std::uint32_t n, std::uint32_t* count, XrSwapchainImageOpenGLKHR* out) {
        return xrEnumerateSwapchainImages(swapchain, n, count,
                                          reinterpret_cast<XrSwapchainImageBaseHeader*>(out));
      },
      "xrEnumerateSwapchainImages", {XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR, nullptr, 0});
  std::vector<std::uint32_t> textures;
  for (const XrSwapchainImageOpenGLKHR& image : images) textures.push_back(image.image);
  return textures;
}

std::int64_t chooseFormat(const std::vector<std::int64_t>& offered, Blend blend) {
  const auto isOffered = [&](std::int64_t format) {
    return std::find(offered.begin(), offered.end(), format) != offered.end();
  };
  if (isOffered(GL_SRGB8_ALPHA8)) return GL_SRGB8_ALPHA8;
  constexpr std::int64_t kWithAlpha[] = {GL_RGBA16F, GL_RGBA16, GL_RGBA32F, GL_RGBA8},
                         kWithout[] = {GL_SRGB8, GL_RGB10_A2, GL_R11F_G11F_B10F, GL_RGB16F,
                                       GL_RGB8};
  for (const std::int64_t format : offered)
    if (std::find(std::begin(kWithAlpha), std::end(kWithAlpha), format) != std::end(kWithAlpha))
      return format;
  for (const std::int64_t format : offered)
    if (blend != Blend::alpha &&
        std::find(std::begin(kWithout), std::end(kWithout), format) != std::end(kWithout))
      return format;
  return 0;
}

}  // namespace palpa::ar
