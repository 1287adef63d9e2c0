#pragma once

#include <array>

#include "ar/headset/headset.h"
#include "scene/scene_state.h"

namespace palpa::headset {

/// The camera of an eye for a picture of `width` x `height` pixels: u = fx X/Z + cx with pixel
/// centres at whole numbers, so that the tangents `left` .. `right` lie at -1/2 .. width - 1/2, and
/// `up` .. `down` at -1/2 .. height - 1/2.
scene::Pinhole pinholeOf(const ar::EyeView& eye, int width, int height);

/// Pose of W (+z up, +y away from the person) in L for a person whose eyes are there: `focus_W`,
/// what the work is about, lies before and below them, W's +y along the way they look, level.
Pose placeBefore(const std::array<ar::EyeView, 2>& eyes, const Vec3& focus_W);

}  // namespace palpa::headset
