#include "ar/headset/xr_frames.h"

#include <glm/gtc/quaternion.hpp>

namespace palpa::ar {
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
