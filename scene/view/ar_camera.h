#pragma once

#include <array>
#include <initializer_list>

#include "scene/panels.h"
#include "scene/scene_state.h"

class vtkCamera;

/// The one place where OpenCV's camera meets VTK's: axes, half pixels, clip space.
namespace palpa::scene {

struct DepthRange {
  double near = 0.01, far = 10;  ///< metres in front of the camera
};

/// Clip-space matrix of a pinhole, for an eye frame with +x right, +y up, +z backward (OpenGL):
///
///     u = fx X / Z + cx,   v = fy Y / Z + cy         (C: +x right, +y down, +z forward)
///     x_ndc = 2 (u + 1/2) / width - 1,  y_ndc = 1 - 2 (v + 1/2) / height
///
/// The halves are there because u = 0 is the centre of the first pixel, and x_ndc = -1 its left
/// edge.
Mat4 projectionMatrix(const Pinhole& camera, const DepthRange& range);

struct Ball {
  Vec3 centre_C = Vec3::Zero();
  double radius = 0;
};

/// Depth range that holds all the balls, kept positive and not needlessly wide.
DepthRange depthRangeOf(std::initializer_list<Ball> balls);

/// Makes `target` the camera at X_CA with exactly these intrinsics.
void aim(vtkCamera& target, const Pinhole& camera, const Pose& X_CA, const DepthRange& range);

/// The same camera for a picture stretched to width x height pixels.
Pinhole scaled(const Pinhole& camera, int width, int height);

/// The same camera for a part of its picture.
Pinhole partOf(const Pinhole& camera, const Rect& part);

}  // namespace palpa::scene
