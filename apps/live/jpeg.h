#pragma once

#include <string>

#include "scene/scene_state.h"

namespace palpa::live {

/// An RGB picture as JPEG, no wider than `widest` (0: as it is); quality 1 to 100.
std::string jpegOf(const scene::Image& image, int quality, int widest = 0);

}  // namespace palpa::live
