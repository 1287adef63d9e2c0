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

}  // namespace palpa::scene

/// Two eyes: two perspective cameras of their own, never one picture shifted.
namespace palpa::scene {

/// Left and right of a camera, `apart` metres from each other along its x axis, axes parallel. The
/// principal points are shifted so that a point `focus` metres ahead is seen at the same pixel by
/// both: what is nearer stands before the screen.
///   X_EC: shift by +-apart/2;   cx_E = cx -+ fx apart / (2 focus)
std::array<EyeCamera, 2> stereoPair(const Pinhole& camera, const Pose& X_CA, double apart,
                                    double focus);

/// Where each eye's view lies; both everywhere for an anaglyph.
std::array<Rect, 2> eyePanels(const Rect& panel, Stereo stereo);

/// Where words go that both eyes read: a rectangle 0.56 m x 0.36 m, a metre ahead of the middle
/// between them and a little above what they look at, as each eye's panel has it; shifted alike for
/// both into panels that see less.
std::array<Rect, 2> wordPanels(const std::array<EyeCamera, 2>& eyes,
                               const std::array<Rect, 2>& panels);

/// For glasses red before the left eye, cyan before the right: red from the left picture's
/// brightness, green and blue from the right one. Both of one size.
Image anaglyph(const Image& left, const Image& right);

}  // namespace palpa::scene
