#pragma once

#include <memory>

#include "scene/scene_view.h"

class vtkRenderWindow;

namespace palpa::scene {

/// Collects what a person does in an X window. VTK's own interactor styles are left out: there 'e'
/// and 'q' end the program and the mouse moves the camera behind our back.
class WindowInput {
 public:
  explicit WindowInput(vtkRenderWindow& window);  ///< after the window's first frame
  ~WindowInput();

  ViewInput poll();  ///< everything since the last call

 private:
  struct Events;
  std::unique_ptr<Events> events_;
};

}  // namespace palpa::scene
