#pragma once

#include "scene/orbit_camera.h"
#include "scene/scene_view.h"
#include "scene/view_layout.h"

namespace palpa::scene {

/// Dragging in the AR view walks the virtual camera: middle button around the entry point, right
/// button up and down nearer and farther; with Shift either one moves sideways. The left button and
/// the wheel belong to the program.
class Navigation {
 public:
  void apply(const ViewInput& input, const Rect& view, int window_height, OrbitCamera& camera);

 private:
  bool dragging_ = false;  // began inside the view
  double x_ = 0, y_ = 0;
};

}  // namespace palpa::scene
