#pragma once

#include <openxr/openxr.h>

#include "anatomy/geometry/pose.h"

/// The one place where OpenXR's axes (+x right, +y up, +z toward the person; everything looks along
/// -z) meet ours.
namespace palpa::ar {

/// Pose in L (+z up) of something that looks along its own +z (eye, head, hand).
Pose poseFromXr(const XrPosef& pose_in_space);
XrVector3f positionToXr(const Vec3& p_L);
XrPosef identityXr();

}  // namespace palpa::ar
