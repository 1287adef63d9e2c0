#pragma once

#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

#include "scene/scene_state.h"
#include "scene/sight.h"

class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// What lies inside: translucent balls, each with its outline as the eye sees it. Found: yellow,
/// the outline closed. Not found: vermilion, the outline dashed. Normal: gray, the outline closed.
class LumpBalls {
 public:
  /// `through`: after the translucent skin, with the depths of what is opaque, so that a tool hides
  /// them. `above`: where a solid skin would.
  LumpBalls(vtkRenderer& through, vtkRenderer& above, double ring_px);
  ~LumpBalls();

  void update(const std::vector<Lump>& lumps, const Sight& sight, bool solid_skin);
  bool any() const { return shown_ > 0; }

 private:
  struct LumpBall;
  vtkRenderer &through_, &above_;
  double ring_px_;
  vtkSmartPointer<vtkPolyData> sphere_, ring_, dashes_;
  std::vector<std::unique_ptr<LumpBall>> balls_;
  std::size_t shown_ = 0;
};

}  // namespace palpa::scene
