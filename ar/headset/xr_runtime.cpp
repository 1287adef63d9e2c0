#include "ar/headset/xr_runtime.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "anatomy/base/error.h"

namespace palpa::ar {
namespace {

constexpr const char* kWhere = "headset";
constexpr const char* kOther = "Use another runtime, or --display window";

XrOwnedInstance makeInstance(const std::vector<const char*>& extensions) {
  XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO, nullptr, 0, {}, 0, nullptr, 0, nullptr};
  std::strncpy(info.applicationInfo.applicationName, "Palpa", XR_MAX_APPLICATION_NAME_SIZE - 1);
  info.applicationInfo.applicationVersion = 1;
  info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.enabledExtensionNames = extensions.data();
  XrInstance instance = XR_NULL_HANDLE;
  xrCheck(xrCreateInstance(&info, &instance), "xrCreateInstance");
  return XrOwnedInstance(instance);
}

std::string namesOf(XrInstance instance, XrSystemId system) {
  XrInstanceProperties runtime{XR_TYPE_INSTANCE_PROPERTIES, nullptr, 0, {}};
  XrSystemProperties device{XR_TYPE_SYSTEM_PROPERTIES, nullptr, 0, 0, {}, {}, {}};
  xrCheck(xrGetInstanceProperties(instance, &runtime), "xrGetInstanceProperties");
  xrCheck(xrGetSystemProperties(instance, system, &device), "xrGetSystemProperties");
  return std::string(device.systemName) + " by " + runtime.runtimeName;
}

std::array<XrViewConfigurationView, 2> stereoViews(XrInstance instance, XrSystemId system) {
  const auto kinds = xrListed<XrViewConfigurationType>(
      [&](std::uint32_t n, std::uint32_t* count, XrViewConfigurationType* out) {
        return xrEnumerateViewConfigurations(instance, system, n, count, out);
      },
      "xrEnumerateViewConfigurations");
  if (std::find(kinds.begin(), kinds.end(), kTwoEyes) == kinds.end())
    throw Error("the headset does not show two eyes' pictures", kWhere, kOther);
  const auto views = xrListed<XrViewConfigurationView>(
      [&](std::uint32_t n, std::uint32_t* count, XrViewConfigurationView* out) {
        return xrEnumerateViewConfigurationViews(instance, system, kTwoEyes, n, count, out);
      },
      "xrEnumerateViewConfigurationViews",
      {XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, 0, 0, 0, 0, 0, 0});
  if (views.size() != 2)
    throw Error("the headset has " + std::to_string(views.size()) + " views for two eyes", kWhere,
                kOther);
  return {views[0], views[1]};
}

XrEnvironmentBlendMode preferredBlend(XrInstance instance, XrSystemId system) {
  const auto modes = xrListed<XrEnvironmentBlendMode>(
      [&](std::uint32_t n, std::uint32_t* count, XrEnvironmentBlendMode* out) {
        return xrEnumerateEnvironmentBlendModes(instance, system, kTwoEyes, n, count, out);
      },
      "xrEnumerateEnvironmentBlendModes");
  for (const XrEnvironmentBlendMode mode : modes)
    if (mode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE || mode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE ||
        mode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND)
      return mode;
  throw Error("the headset shows pictures in no way that is known here", kWhere, kOther);
}

}  // namespace

Blend blendOf(XrEnvironmentBlendMode mode) {
  return mode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE      ? Blend::additive
         : mode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND ? Blend::alpha
                                                         : Blend::opaque;
}

XrRuntime openRuntime(GlPlatform kind) try {
  XrRuntime runtime;
  runtime.instance = makeInstance(graphicsExtensions(kind));
  const XrInstance instance = runtime.instance.get();
  const XrSystemGetInfo head{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
  xrCheck(xrGetSystem(instance, &head, &runtime.system), "xrGetSystem");
  runtime.name = namesOf(instance, runtime.system);
  runtime.views = stereoViews(instance, runtime.system);
  runtime.blend = preferredBlend(instance, runtime.system);
  return runtime;
} catch (const XrFailure& failure) {
  const XrWords words = inWords(failure);
  throw Error(words.what, kWhere, words.advice);
}

}  // namespace palpa::ar
