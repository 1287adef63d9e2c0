#pragma once

#include <array>

#include "scene/scene_state.h"
#include "scene/view_layout.h"

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
