#pragma once

#include <array>
#include <string>

#include "ar/headset/headset.h"
#include "ar/headset/xr_call.h"

namespace palpa::ar {

constexpr XrViewConfigurationType kTwoEyes = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

/// The computer's OpenXR runtime and its headset, before anything is shown.
struct XrRuntime {
  XrOwnedInstance instance;
  XrSystemId system = XR_NULL_SYSTEM_ID;
  std::string name;  ///< "<headset> by <runtime>"
  std::array<XrViewConfigurationView, 2> views;
  XrEnvironmentBlendMode blend =
      XR_ENVIRONMENT_BLEND_MODE_OPAQUE;  ///< the one that it prefers of those that we know
};

/// Throws Error, in words.
XrRuntime openRuntime(GlBinding::Kind kind);

Blend blendOf(XrEnvironmentBlendMode mode);

}  // namespace palpa::ar
