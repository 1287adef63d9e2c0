#pragma once

#include "scene/scene_state.h"

class vtkRenderWindow;

namespace palpa::scene {

/// What the window shows: RGB, top row first. Throws Error when it cannot be read.
Image pixelsOf(vtkRenderWindow& window);

}  // namespace palpa::scene
