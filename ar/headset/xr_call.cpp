#include "ar/headset/xr_call.h"

#include <openxr/openxr_reflection.h>
#include <glm/gtc/quaternion.hpp>

namespace palpa::ar {
namespace {

std::string nameOf(XrResult result) {
  switch (result) {
#define PALPA_CASE(name, value) \
  case name:                    \
    return #name;
    XR_LIST_ENUM_XrResult(PALPA_CASE)
#undef PALPA_CASE
        default : return std::to_string(result);
  }
}

}  // namespace

XrFailure::XrFailure(XrResult result, const std::string& call)
    : std::runtime_error(call + ": " + nameOf(result)), result_(result) {}

XrResult xrCheck(XrResult result, const char* call) {
  if (XR_FAILED(result)) throw XrFailure(result, call);
  return result;
}

XrWords inWords(const XrFailure& failure) {
  switch (failure.result()) {
    case XR_ERROR_RUNTIME_UNAVAILABLE:
      return {"no OpenXR runtime is there",
              "Install and start the headset's own (Monado, SteamVR, ...), or set XR_RUNTIME_JSON"};
    case XR_ERROR_RUNTIME_FAILURE:
      return {"the OpenXR runtime does not work", "Start the headset's own software again"};
    case XR_ERROR_FORM_FACTOR_UNAVAILABLE:
      return {"no headset is connected", "Connect it, switch it on, and start again"};
    case XR_ERROR_FORM_FACTOR_UNSUPPORTED:
      return {"the OpenXR runtime drives no headset", "Start the runtime of the headset"};
    case XR_ERROR_SESSION_LOST:
    case XR_ERROR_INSTANCE_LOST:
      return {"the headset was lost", "Look at its cable and at its own software"};
    case XR_ERROR_EXTENSION_NOT_PRESENT:
      return {"the headset's runtime takes no pictures from OpenGL, or not without a desktop (EGL)",
              "Start it from a desktop session, or use another runtime"};
    case XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED:
      return {"the headset's runtime takes pictures of no format that is known here",
              "Use another runtime"};
    case XR_ERROR_GRAPHICS_DEVICE_INVALID:
      return {"the headset cannot take pictures from this graphics driver",
              "Connect it to the graphics card that draws"};
    default:
      return {std::string("the headset's runtime refused a call (") + failure.what() + ")",
              "Start the headset's own software again"};
  }
}

namespace {

/// Of a point in OpenXR's spaces, in L.
Vec3 turnedUp(const glm::dvec3& p) { return {p.x, -p.z, p.y}; }

}  // namespace

Pose poseFromXr(const XrPosef& pose) {
  const glm::dquat q = glm::normalize(
      glm::dquat(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z));
  Mat3 R;  // columns: ours are +x, -y, -z of OpenXR's
  R << turnedUp(q * glm::dvec3(1, 0, 0)), turnedUp(q * glm::dvec3(0, -1, 0)),
      turnedUp(q * glm::dvec3(0, 0, -1));
  return makePose(R, turnedUp({pose.position.x, pose.position.y, pose.position.z}));
}

XrVector3f positionToXr(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.z()), static_cast<float>(-p.y())};
}

XrPosef identityXr() { return {{0, 0, 0, 1}, {0, 0, 0}}; }

}  // namespace palpa::ar
