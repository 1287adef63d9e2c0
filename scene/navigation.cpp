#include "scene/navigation.h"

#include <cmath>
#include <numbers>

namespace palpa::scene {

void Navigation::apply(const ViewInput& input, const Rect& view, int window_height,
                       OrbitCamera& camera) {
  const bool pressed = input.middle_button || input.right_button;
  const double dx = (input.mouse_x - x_) / view.height;
  const double dy = (input.mouse_y - y_) / view.height;
  x_ = input.mouse_x;
  y_ = input.mouse_y;
  if (!pressed || !dragging_) {
    dragging_ = pressed && view.contains(input.mouse_x, window_height - 1 - input.mouse_y);
    return;
  }
  if (input.shift) {
    camera.pan(dx, dy);
  } else if (input.middle_button) {
    camera.orbit(-std::numbers::pi * dx, std::numbers::pi * dy);  // a drag of one height: 180°
  } else {
    camera.zoom(std::exp2(2 * dy));
  }
}

}  // namespace palpa::scene
