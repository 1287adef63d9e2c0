#pragma once

#include <vector>

#include "ar/headset/headset.h"
#include "ar/headset/xr_call.h"

/// All that OpenXR has to know of OpenGL.
namespace palpa::ar {

/// Names of the extensions by which a context of this kind is handed over.
std::vector<const char*> graphicsExtensions(GlBinding::Kind kind);

/// Asks for the runtime's requirements, as it must be asked, and makes the session.
XrOwnedSession makeSession(XrInstance instance, XrSystemId system, const GlBinding& gl);

/// OpenGL's names of a swapchain's pictures.
std::vector<std::uint32_t> texturesOf(XrSwapchain swapchain);

/// Which of the formats that the runtime offers we draw into; 0: none. Encoded (sRGB) colours with
/// alpha before all; with alpha before without, which does not serve where the picture's alpha is
/// needed; otherwise in the runtime's own order.
std::int64_t chooseFormat(const std::vector<std::int64_t>& offered, Blend blend);

}  // namespace palpa::ar
