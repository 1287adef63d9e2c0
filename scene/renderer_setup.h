#pragma once

#include "scene/palette.h"
#include "scene/view_layout.h"

class vtkRenderer;

namespace palpa::scene {

/// Plain background and one light over the viewer's left shoulder, so that round things look round.
void setUpRenderer(vtkRenderer& renderer, const Rgb& background);

/// Exactly these pixels of the window.
void setViewport(vtkRenderer& renderer, const Rect& where, int window_width, int window_height);

}  // namespace palpa::scene
