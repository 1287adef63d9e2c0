#pragma once

#include <memory>
#include <vector>

#include "scene/sight.h"

class vtkRenderer;

namespace palpa::scene {

/// Places somebody has marked: pins as on maps, numbered from 1, upright and of one size on the
/// screen.
class Pins {
 public:
  explicit Pins(vtkRenderer& renderer);
  ~Pins();

  /// `head_px`: radius of a pin's head.
  void update(const std::vector<Vec3>& places_A, const Sight& sight, double head_px);
  bool any() const { return shown_ > 0; }

 private:
  struct Pin;
  vtkRenderer& renderer_;
  std::vector<std::unique_ptr<Pin>> pins_;
  std::size_t shown_ = 0;
};

}  // namespace palpa::scene
