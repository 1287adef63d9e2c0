#pragma once

#include <vtkNew.h>

#include "scene/backdrop.h"
#include "scene/scene_state.h"
#include "scene/view_layout.h"

class vtkRenderer;
class vtkRenderWindow;

namespace palpa::scene {

/// The camera's picture without the overlay, at the lower right of a panel, a quarter as wide: an
/// overlay must not take from the real scene what it hides.
class CameraInset {
 public:
  explicit CameraInset(vtkRenderWindow& window);
  ~CameraInset();
  void show(const Image* picture, const Rect& panel, int window_width,
            int window_height);  ///< null: nothing

 private:
  vtkRenderWindow& window_;
  vtkNew<vtkRenderer> frame_, picture_;  // its edge, the picture in it
  Backdrop backdrop_;
};

/// Where it lies, edge included.
Rect insetRect(const Rect& panel, int picture_width, int picture_height);

}  // namespace palpa::scene
