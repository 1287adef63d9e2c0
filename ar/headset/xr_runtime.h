#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

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
  /// the one that it prefers of those that we know
  XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
};

/// Throws Error, in words.
XrRuntime openRuntime(GlPlatform kind);

Blend blendOf(XrEnvironmentBlendMode mode);

}  // namespace palpa::ar

/// All that OpenXR has to know of OpenGL.
namespace palpa::ar {

/// Names of the extensions by which a context of this kind is handed over.
std::vector<const char*> graphicsExtensions(GlPlatform kind);

/// Makes it the calling thread's; false: it cannot be had. (Nothing is taken where there is none.)
bool takeContext(const GlBinding& gl);
/// The calling thread's no more, if it is.
void letGoOfContext(const GlBinding& gl);

/// Asks for the runtime's requirements, as it must be asked, and makes the session.
XrOwnedSession makeSession(XrInstance instance, XrSystemId system, const GlBinding& gl);

/// OpenGL's names of a swapchain's pictures.
std::vector<std::uint32_t> texturesOf(XrSwapchain swapchain);

/// Which of the formats that the runtime offers we draw into; 0: none. Encoded (sRGB) colours with
/// alpha before all; with alpha before without, which does not serve where the picture's alpha is
/// needed; otherwise in the runtime's own order.
std::int64_t chooseFormat(const std::vector<std::int64_t>& offered, Blend blend);

}  // namespace palpa::ar
