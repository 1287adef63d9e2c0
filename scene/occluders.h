#pragma once

#include <memory>
#include <vector>

#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// Real things in the camera's picture that hide what is drawn behind them: they fill the depths
/// and leave the colours, which are the picture's. Drawn before everything else of their renderer.
class Occluders {
 public:
  explicit Occluders(vtkRenderer& renderer);
  ~Occluders();
  /// Nothing is hidden where there is no picture.
  void update(const std::vector<Occluder>& things, bool picture);

 private:
  struct Thing;
  vtkRenderer& renderer_;
  std::vector<std::unique_ptr<Thing>> things_;
};

}  // namespace palpa::scene
