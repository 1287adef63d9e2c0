#include <cmath>
#include <cstring>

#include "tests/openxr_runtime/world.h"

namespace palpa::test_xr {
namespace {

XrExtensionProperties extension(const char* name, std::uint32_t version) {
  XrExtensionProperties e{XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, version};
  std::strncpy(e.extensionName, name, XR_MAX_EXTENSION_NAME_SIZE - 1);
  return e;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateInstanceExtensionProperties(const char*,
                                                                    std::uint32_t capacity,
                                                                    std::uint32_t* count,
                                                                    XrExtensionProperties* out) {
  std::vector<XrExtensionProperties> all{extension(XR_MNDX_EGL_ENABLE_EXTENSION_NAME, 1)};
  if (!planFromEnvironment().failsFromTheStart("no_opengl"))
    all.push_back(extension(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME, 10));
  return give(all, capacity, count, out);
}

XRAPI_ATTR XrResult XRAPI_CALL CreateInstance(const XrInstanceCreateInfo*, XrInstance* instance) {
  world() = {};
  World& w = world();
  w.plan = planFromEnvironment();
  if (w.plan.failsFromTheStart("runtime_failure")) return XR_ERROR_RUNTIME_FAILURE;
  w.ledger.called("xrCreateInstance");
  *instance = w.instance = w.ledger.opened<XrInstance>("instance");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL DestroyInstance(XrInstance instance) {
  World& w = world();
  w.ledger.called("xrDestroyInstance");
  w.ledger.closed(instance);
  w.ledger.write(w.plan.report);
  dismissService();
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetInstanceProperties(XrInstance, XrInstanceProperties* p) {
  p->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
  std::strcpy(p->runtimeName, "Palpa's test runtime");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL PollEvent(XrInstance, XrEventDataBuffer* event) {
  World& w = world();
  const std::lock_guard lock(shared());
  w.ledger.called("xrPollEvent");
  if (w.faultNow("instance_lost")) return XR_ERROR_INSTANCE_LOST;
  if (w.events.empty()) return XR_EVENT_UNAVAILABLE;
  *event = w.events.front();
  w.events.pop_front();
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL ResultToString(XrInstance, XrResult value,
                                              char buffer[XR_MAX_RESULT_STRING_SIZE]) {
  std::strncpy(buffer, std::to_string(value).c_str(), XR_MAX_RESULT_STRING_SIZE - 1);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL StructureTypeToString(XrInstance, XrStructureType value,
                                                     char buffer[XR_MAX_STRUCTURE_NAME_SIZE]) {
  std::strncpy(buffer, std::to_string(value).c_str(), XR_MAX_STRUCTURE_NAME_SIZE - 1);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetSystem(XrInstance, const XrSystemGetInfo* info, XrSystemId* id) {
  World& w = world();
  if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY ||
      w.plan.failsFromTheStart("no_headset_kind"))
    return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
  if (w.plan.failsFromTheStart("no_headset")) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  *id = 7;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetSystemProperties(XrInstance, XrSystemId id,
                                                   XrSystemProperties* p) {
  p->systemId = id;
  p->vendorId = 1;
  std::strcpy(p->systemName, "No headset at all");
  p->graphicsProperties = {4096, 4096, 16};
  p->trackingProperties = {XR_TRUE, static_cast<XrBool32>(world().plan.position)};
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateEnvironmentBlendModes(XrInstance, XrSystemId,
                                                              XrViewConfigurationType,
                                                              std::uint32_t capacity,
                                                              std::uint32_t* count,
                                                              XrEnvironmentBlendMode* out) {
  const std::string& blend = world().plan.blend;
  const XrEnvironmentBlendMode mode = blend == "additive" ? XR_ENVIRONMENT_BLEND_MODE_ADDITIVE
                                      : blend == "alpha"  ? XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND
                                                          : XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  return give(std::vector{mode}, capacity, count, out);
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateViewConfigurations(XrInstance, XrSystemId,
                                                           std::uint32_t capacity,
                                                           std::uint32_t* count,
                                                           XrViewConfigurationType* out) {
  const bool mono = world().plan.failsFromTheStart("one_eye");
  return give(std::vector{mono ? XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO
                               : XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO},
              capacity, count, out);
}

XRAPI_ATTR XrResult XRAPI_CALL GetViewConfigurationProperties(XrInstance, XrSystemId,
                                                              XrViewConfigurationType type,
                                                              XrViewConfigurationProperties* p) {
  p->viewConfigurationType = type;
  p->fovMutable = XR_FALSE;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateViewConfigurationViews(XrInstance, XrSystemId,
                                                               XrViewConfigurationType,
                                                               std::uint32_t capacity,
                                                               std::uint32_t* count,
                                                               XrViewConfigurationView* out) {
  std::vector<XrViewConfigurationView> views;
  for (const auto& [width, height] : world().plan.eyes)
    views.push_back({XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, static_cast<std::uint32_t>(width),
                     4096, static_cast<std::uint32_t>(height), 4096, 1, 4});
  return give(views, capacity, count, out);
}

XRAPI_ATTR XrResult XRAPI_CALL
GetOpenGLGraphicsRequirementsKHR(XrInstance, XrSystemId, XrGraphicsRequirementsOpenGLKHR* needs) {
  world().ledger.called("xrGetOpenGLGraphicsRequirementsKHR");
  needs->minApiVersionSupported = XR_MAKE_VERSION(3, 2, 0);
  needs->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetInstanceProcAddr(XrInstance, const char* name,
                                                   PFN_xrVoidFunction* function) {
  const auto found = functions().find(name);
  *function = found == functions().end() ? nullptr : found->second;
  return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

World& world() {
  static World& the_world =
      *new World;  // outlives everybody: a thread may hang in it when the program ends
  return the_world;
}

std::mutex& shared() {
  static std::mutex one;
  return one;
}

void World::tell(XrSessionState state) {
  XrEventDataBuffer buffer{XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
  const XrEventDataSessionStateChanged event{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr,
                                             session, state, now};
  std::memcpy(&buffer, &event, sizeof event);
  events.push_back(buffer);
}

void addInstanceFunctions(std::map<std::string, PFN_xrVoidFunction>* all) {
  PALPA_XR(EnumerateInstanceExtensionProperties);
  PALPA_XR(CreateInstance);
  PALPA_XR(DestroyInstance);
  PALPA_XR(GetInstanceProperties);
  PALPA_XR(PollEvent);
  PALPA_XR(ResultToString);
  PALPA_XR(StructureTypeToString);
  PALPA_XR(GetSystem);
  PALPA_XR(GetSystemProperties);
  PALPA_XR(EnumerateEnvironmentBlendModes);
  PALPA_XR(EnumerateViewConfigurations);
  PALPA_XR(GetViewConfigurationProperties);
  PALPA_XR(EnumerateViewConfigurationViews);
  PALPA_XR(GetOpenGLGraphicsRequirementsKHR);
  PALPA_XR(GetInstanceProcAddr);
}

const std::map<std::string, PFN_xrVoidFunction>& functions() {
  static const std::map<std::string, PFN_xrVoidFunction> all = [] {
    std::map<std::string, PFN_xrVoidFunction> made;
    addInstanceFunctions(&made);
    addSessionFunctions(&made);
    addInputFunctions(&made);
    return made;
  }();
  return all;
}

}  // namespace palpa::test_xr

namespace {

// The handshake of loader and runtime (OpenXR loader specification, "Runtime negotiation"); Debian
// ships no header for it.
struct LoaderInfo {
  std::uint32_t structType, structVersion;
  std::size_t structSize;
  std::uint32_t minInterfaceVersion, maxInterfaceVersion;
  XrVersion minApiVersion, maxApiVersion;
};
struct RuntimeRequest {
  std::uint32_t structType, structVersion;
  std::size_t structSize;
  std::uint32_t runtimeInterfaceVersion;
  XrVersion runtimeApiVersion;
  PFN_xrGetInstanceProcAddr getInstanceProcAddr;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(
    const LoaderInfo* loader, RuntimeRequest* request) {
  if (!loader || !request || loader->minInterfaceVersion > 1 || loader->maxInterfaceVersion < 1)
    return XR_ERROR_INITIALIZATION_FAILED;
  request->runtimeInterfaceVersion = 1;
  request->runtimeApiVersion = XR_MAKE_VERSION(1, 0, 20);
  request->getInstanceProcAddr = reinterpret_cast<PFN_xrGetInstanceProcAddr>(
      palpa::test_xr::functions().at("xrGetInstanceProcAddr"));
  return XR_SUCCESS;
}
