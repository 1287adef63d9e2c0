#pragma once

#include <vtkNew.h>

#include "scene/palette.h"
#include "scene/view_layout.h"

class vtkActor2D;
class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// Flat coloured rectangles with round corners, drawn under the text of a renderer: what makes
/// words legible on any picture. All of them are one draw call.
class Plates {
 public:
  explicit Plates(vtkRenderer& renderer);
  ~Plates();

  void clear();
  void setVisible(bool visible);
  void add(const Rect& where, const Rgba& colour, int corner_px);

 private:
  vtkNew<vtkPolyData> shapes_;
  vtkNew<vtkActor2D> actor_;
};

}  // namespace palpa::scene
