#pragma once

#include <vtkSmartPointer.h>

#include "scene/palette.h"
#include "scene/panels.h"

class vtkMapper;
class vtkPolyDataMapper;

namespace palpa::scene {

/// A mapper of surfaces that can be told what its drawing leaves behind: colours, depths, or both.
vtkSmartPointer<vtkPolyDataMapper> makePassMapper();
/// Of such a mapper.
void setWrites(vtkMapper& mapper, bool colours, bool depths);

}  // namespace palpa::scene

class vtkRenderer;

namespace palpa::scene {

/// Plain background and one light over the viewer's left shoulder, so that round things look round.
void setUpRenderer(vtkRenderer& renderer, const Rgb& background);

/// Exactly these pixels of the window.
void setViewport(vtkRenderer& renderer, const Rect& where, int window_width, int window_height);

}  // namespace palpa::scene
