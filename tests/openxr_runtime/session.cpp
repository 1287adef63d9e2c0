#include <unistd.h>

#include <cmath>
#include <fstream>

#include "tests/openxr_runtime/world.h"

namespace palpa::test_xr {
namespace {

constexpr float kDegree = 0.017453292f;
// Unlike on all sides, and unlike for both eyes.
constexpr XrFovf kFov[] = {{-48 * kDegree, 40 * kDegree, 42 * kDegree, -46 * kDegree},
                           {-40 * kDegree, 48 * kDegree, 42 * kDegree, -46 * kDegree}};
constexpr XrPosef kIdentity{{0, 0, 0, 1}, {0, 0, 0}};

bool contextIsCurrent() {
  return eglGetCurrentContext() != EGL_NO_CONTEXT || glXGetCurrentContext() != nullptr;
}

XRAPI_ATTR XrResult XRAPI_CALL CreateSession(XrInstance, const XrSessionCreateInfo* info,
                                             XrSession* session) {
  World& w = world();
  w.ledger.called("xrCreateSession");
  if (!w.ledger.calls("xrGetOpenGLGraphicsRequirementsKHR"))
    return XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING;
  const auto* binding = static_cast<const XrBaseInStructure*>(info->next);
  if (!binding || w.plan.failsFromTheStart("no_graphics")) return XR_ERROR_GRAPHICS_DEVICE_INVALID;
  if (binding->type == XR_TYPE_GRAPHICS_BINDING_EGL_MNDX) {
    const auto* egl = reinterpret_cast<const XrGraphicsBindingEGLMNDX*>(binding);
    if (egl->context != eglGetCurrentContext() || !egl->display || !egl->config ||
        !egl->getProcAddress)
      w.ledger.complain("the EGL context that was handed over is not the current one");
  } else if (binding->type == XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR) {
    const auto* glx = reinterpret_cast<const XrGraphicsBindingOpenGLXlibKHR*>(binding);
    if (glx->glxContext != glXGetCurrentContext() || !glx->xDisplay || !glx->glxDrawable)
      w.ledger.complain("the GLX context that was handed over is not the current one");
    if (!glx->glxFBConfig) w.ledger.complain("no GLXFBConfig was handed over");
  } else {
    return XR_ERROR_GRAPHICS_DEVICE_INVALID;
  }
  *session = w.session = w.ledger.opened<XrSession>("session");
  w.tell(XR_SESSION_STATE_IDLE);
  if (!w.plan.failsFromTheStart("never_worn")) w.tell(XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL DestroySession(XrSession session) {
  World& w = world();
  w.ledger.called("xrDestroySession");
  w.ledger.closed(session);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL BeginSession(XrSession, const XrSessionBeginInfo* info) {
  World& w = world();
  w.ledger.called("xrBeginSession");
  if (info->primaryViewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
    return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
  if (w.running) return XR_ERROR_SESSION_RUNNING;
  w.running = true;
  w.tell(XR_SESSION_STATE_SYNCHRONIZED);
  w.tell(XR_SESSION_STATE_VISIBLE);
  w.tell(XR_SESSION_STATE_FOCUSED);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EndSession(XrSession) {
  World& w = world();
  w.ledger.called("xrEndSession");
  if (!w.running) return XR_ERROR_SESSION_NOT_RUNNING;
  w.running = false;
  w.tell(XR_SESSION_STATE_IDLE);
  w.tell(w.exit_asked ? XR_SESSION_STATE_EXITING
                      : XR_SESSION_STATE_READY);  // taken off, put on again
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL RequestExitSession(XrSession) {
  World& w = world();
  w.ledger.called("xrRequestExitSession");
  if (!w.running) return XR_ERROR_SESSION_NOT_RUNNING;
  w.exit_asked = true;
  w.tell(XR_SESSION_STATE_STOPPING);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateSwapchainFormats(XrSession, std::uint32_t capacity,
                                                         std::uint32_t* count, std::int64_t* out) {
  return give(world().plan.formats, capacity, count, out);
}

XRAPI_ATTR XrResult XRAPI_CALL CreateSwapchain(XrSession, const XrSwapchainCreateInfo* info,
                                               XrSwapchain* swapchain) {
  World& w = world();
  w.ledger.called("xrCreateSwapchain");
  if (!contextIsCurrent()) w.ledger.complain("xrCreateSwapchain without the context");
  Swapchain made;
  made.width = static_cast<int>(info->width);
  made.height = static_cast<int>(info->height);
  made.textures.resize(static_cast<std::size_t>(w.plan.images));
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  glGenTextures(w.plan.images, made.textures.data());
  for (const GLuint texture : made.textures) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(info->format), made.width, made.height, 0,
                 GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  }
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  *swapchain = w.ledger.opened<XrSwapchain>("swapchain");
  w.swapchains[*swapchain] = made;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL DestroySwapchain(XrSwapchain swapchain) {
  World& w = world();
  w.ledger.called("xrDestroySwapchain");
  w.ledger.closed(swapchain);
  Swapchain& gone = w.swapchains[swapchain];
  if (!contextIsCurrent()) w.ledger.complain("xrDestroySwapchain without the context");
  glDeleteTextures(static_cast<GLsizei>(gone.textures.size()), gone.textures.data());
  w.swapchains.erase(swapchain);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateSwapchainImages(XrSwapchain swapchain,
                                                        std::uint32_t capacity,
                                                        std::uint32_t* count,
                                                        XrSwapchainImageBaseHeader* out) {
  const Swapchain& s = world().swapchains[swapchain];
  *count = static_cast<std::uint32_t>(s.textures.size());
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < s.textures.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  for (std::size_t i = 0; i < s.textures.size(); ++i)
    reinterpret_cast<XrSwapchainImageOpenGLKHR*>(out)[i].image = s.textures[i];
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL AcquireSwapchainImage(XrSwapchain swapchain,
                                                     const XrSwapchainImageAcquireInfo*,
                                                     std::uint32_t* index) {
  World& w = world();
  w.ledger.called("xrAcquireSwapchainImage");
  if (w.lost) return XR_ERROR_SESSION_LOST;
  Swapchain& s = w.swapchains[swapchain];
  if (s.held) return XR_ERROR_CALL_ORDER_INVALID;
  s.held = true;
  s.waited = false;
  *index = s.acquired = s.next;
  s.next = (s.next + 1) % static_cast<std::uint32_t>(s.textures.size());
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL WaitSwapchainImage(XrSwapchain swapchain,
                                                  const XrSwapchainImageWaitInfo* info) {
  World& w = world();
  w.ledger.called("xrWaitSwapchainImage");
  if (w.faultNow("stuck_picture")) {
    if (info->timeout == XR_INFINITE_DURATION)
      w.ledger.complain("xrWaitSwapchainImage would never have come back");
    return XR_TIMEOUT_EXPIRED;
  }
  Swapchain& s = w.swapchains[swapchain];
  if (!s.held || s.waited) return XR_ERROR_CALL_ORDER_INVALID;
  if (w.plan.fault == "slow_picture" && w.frame == w.plan.fault_frame &&
      w.ledger.calls("late") == 0) {
    w.ledger.called("late");
    return XR_TIMEOUT_EXPIRED;
  }
  s.waited = true;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL ReleaseSwapchainImage(XrSwapchain swapchain,
                                                     const XrSwapchainImageReleaseInfo*) {
  World& w = world();
  w.ledger.called("xrReleaseSwapchainImage");
  Swapchain& s = w.swapchains[swapchain];
  if (!s.held || !s.waited) return XR_ERROR_CALL_ORDER_INVALID;
  s.held = false;
  s.ever = true;
  s.released = s.acquired;
  return XR_SUCCESS;
}

/// What happens at the beginning of a frame, if it is the one.
void befall(World& w) {
  if (w.frame != w.plan.fault_frame) return;
  const std::string& fault = w.plan.fault;
  if (fault == "session_lost") w.lost = true;
  if (fault == "loss_pending") {
    w.tell(XR_SESSION_STATE_LOSS_PENDING);
    w.tell(XR_SESSION_STATE_STOPPING);  // which says nothing new
  }
  if (fault == "taken_off") w.tell(XR_SESSION_STATE_STOPPING);
  if (fault == "ended_there") {
    w.exit_asked = true;
    w.tell(XR_SESSION_STATE_STOPPING);
  }
  if (fault == "recentred" || fault == "stage_moved") {
    XrEventDataBuffer buffer{XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
    auto* event = reinterpret_cast<XrEventDataReferenceSpaceChangePending*>(&buffer);
    *event = {XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING,
              nullptr,
              w.session,
              fault == "recentred" ? XR_REFERENCE_SPACE_TYPE_LOCAL : XR_REFERENCE_SPACE_TYPE_STAGE,
              w.now,
              XR_TRUE,
              kIdentity};
    w.events.push_back(buffer);
  }
}

XRAPI_ATTR XrResult XRAPI_CALL WaitFrame(XrSession, const XrFrameWaitInfo*, XrFrameState* state) {
  World& w = world();
  const auto period = static_cast<XrDuration>(1e9 / w.plan.rate_Hz);
  while (w.plan.fault == "hung" && w.frame >= w.plan.fault_frame) usleep(10'000);
  usleep(static_cast<useconds_t>(period / 1000));
  const std::lock_guard lock(shared());
  w.ledger.called("xrWaitFrame");
  if (w.lost) return XR_ERROR_SESSION_LOST;
  if (!w.running) return XR_ERROR_SESSION_NOT_RUNNING;
  if (w.frame_waited) w.ledger.complain("xrWaitFrame without an xrBeginFrame in between");
  w.frame_waited = true;
  ++w.frame;
  befall(w);
  if (w.lost) return XR_ERROR_SESSION_LOST;
  w.now += period;
  state->predictedDisplayTime = w.now;
  state->predictedDisplayPeriod = period;
  state->shouldRender = w.plan.fault == "nobody_looks" && w.frame >= w.plan.fault_frame &&
                                w.frame < w.plan.fault_frame + 10
                            ? XR_FALSE
                            : XR_TRUE;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL BeginFrame(XrSession, const XrFrameBeginInfo*) {
  World& w = world();
  w.ledger.called("xrBeginFrame");
  if (!w.frame_waited) return XR_ERROR_CALL_ORDER_INVALID;
  w.frame_waited = false;
  if (w.frame_begun) return XR_FRAME_DISCARDED;
  w.frame_begun = true;
  return XR_SUCCESS;
}

void keepPicture(const World& w, const Swapchain& s, std::size_t eye) {
  std::vector<unsigned char> rgba(static_cast<std::size_t>(4) * s.width * s.height);
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  glBindTexture(GL_TEXTURE_2D, s.textures[s.released]);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  std::ofstream out(w.plan.pictures + "/eye" + std::to_string(eye) + ".pam", std::ios::binary);
  out << "P7\nWIDTH " << s.width << "\nHEIGHT " << s.height
      << "\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n";
  for (int row = s.height - 1; row >= 0; --row)
    out.write(reinterpret_cast<const char*>(&rgba[static_cast<std::size_t>(4) * s.width * row]),
              static_cast<std::streamsize>(4) * s.width);
}

void checkLayer(World& w, const XrCompositionLayerProjection& layer) {
  if (layer.viewCount != 2) return w.ledger.complain("not two views in a layer");
  const bool alpha = layer.layerFlags & XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  if (alpha != (w.plan.blend == "alpha"))
    w.ledger.complain("alpha where there is none, or none where there is");
  for (std::size_t i = 0; i < 2; ++i) {
    const XrCompositionLayerProjectionView& view = layer.views[i];
    const Swapchain& s = w.swapchains[view.subImage.swapchain];
    if (!s.ever || s.held) w.ledger.complain("a picture was shown before it was given back");
    if (view.fov.angleLeft != kFov[i].angleLeft || view.fov.angleUp != kFov[i].angleUp)
      w.ledger.complain("a view has another angle than it was said to have");
    if (view.subImage.imageRect.extent.width != w.plan.eyes[i].first ||
        view.subImage.imageRect.extent.height != w.plan.eyes[i].second)
      w.ledger.complain("a picture is not of the recommended size");
    if (!w.plan.pictures.empty()) keepPicture(w, s, i);
  }
}

XRAPI_ATTR XrResult XRAPI_CALL EndFrame(XrSession, const XrFrameEndInfo* info) {
  World& w = world();
  w.ledger.called("xrEndFrame");
  if (w.lost) return XR_ERROR_SESSION_LOST;
  if (!w.frame_begun) return XR_ERROR_CALL_ORDER_INVALID;
  w.frame_begun = false;
  if (info->displayTime != w.now)
    w.ledger.complain("a frame was shown at another time than predicted");
  for (std::uint32_t i = 0; i < info->layerCount; ++i) {
    w.ledger.called("layers");
    if (!w.plan.layers.empty()) std::ofstream(w.plan.layers, std::ios::app) << '.';
    checkLayer(w, *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[i]));
  }
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL LocateViews(XrSession, const XrViewLocateInfo* info,
                                           XrViewState* state, std::uint32_t capacity,
                                           std::uint32_t* count, XrView* views) {
  World& w = world();
  if (info->displayTime != w.now)
    w.ledger.complain("views were asked for at another time than predicted");
  *count = 2;
  if (capacity < 2) return capacity == 0 ? XR_SUCCESS : XR_ERROR_SIZE_INSUFFICIENT;
  state->viewStateFlags =
      XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_TRACKED_BIT;
  if (w.plan.position)
    state->viewStateFlags |= XR_VIEW_STATE_POSITION_VALID_BIT;  // valid, though not tracked
  for (int i = 0; i < 2; ++i) {
    const double turned = w.plan.turned_deg * kDegree,
                 half = (i - 0.5) * w.plan.apart;  // about the vertical, to the left
    views[i].pose.orientation = {0, static_cast<float>(std::sin(turned / 2)), 0,
                                 static_cast<float>(std::cos(turned / 2))};
    views[i].pose.position = {
        static_cast<float>(half * std::cos(turned) + 1e-3 * w.plan.drift_mm * w.frame), 0,
        static_cast<float>(-half * std::sin(turned))};
    if (!w.plan.position) views[i].pose.position = {NAN, NAN, NAN};
    views[i].fov = kFov[i];
  }
  return XR_SUCCESS;
}

}  // namespace

void addSessionFunctions(std::map<std::string, PFN_xrVoidFunction>* all) {
  PALPA_XR(CreateSession);
  PALPA_XR(DestroySession);
  PALPA_XR(BeginSession);
  PALPA_XR(EndSession);
  PALPA_XR(RequestExitSession);
  PALPA_XR(EnumerateSwapchainFormats);
  PALPA_XR(CreateSwapchain);
  PALPA_XR(DestroySwapchain);
  PALPA_XR(EnumerateSwapchainImages);
  PALPA_XR(AcquireSwapchainImage);
  PALPA_XR(WaitSwapchainImage);
  PALPA_XR(ReleaseSwapchainImage);
  PALPA_XR(WaitFrame);
  PALPA_XR(BeginFrame);
  PALPA_XR(EndFrame);
  PALPA_XR(LocateViews);
}

}  // namespace palpa::test_xr
