#pragma once

#include "scene/coverage_carpet.h"
#include "scene/lump_balls.h"
#include "scene/pins.h"

class vtkRenderer;

namespace palpa::scene {

/// Of a search by hand: what has been felt, what lies inside, what was marked, where to go next.
class SearchOverlay {
 public:
  /// `on_skin` is drawn after the skin and with its depths, `above` over everything; they may be
  /// one. `pin_px`: radius of a pin's head.
  SearchOverlay(vtkRenderer& on_skin, vtkRenderer& above, double line_px);
  ~SearchOverlay();

  void update(const SceneState& state, bool visible, const Sight& sight, double pin_px);
  bool anyOnSkin() const {
    return carpet_.visible() || lead_.visible() || (balls_.any() && !balls_above_);
  }
  bool anyAbove() const { return pins_.any() || (balls_.any() && balls_above_); }

 private:
  void showLead(const SceneState& state, bool visible, const Sight& sight);

  CoverageCarpet carpet_;
  EdgedLines lead_;
  LumpBalls balls_;
  Pins pins_;
  Pose lead_at_ = Pose::Identity();
  bool lead_drawn_ = false;
  bool balls_above_ = false;
};

}  // namespace palpa::scene
