#pragma once

#include <optional>

#include "scene/actors/lines.h"
#include "scene/actors/search_marks.h"
#include "scene/actors/surface_map.h"
#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// What has been felt, as a translucent carpet just over the plane of its grid, and the outline of
/// the whole. Cells that were not felt stay clear. Without light, so that a level has one colour
/// wherever it lies.
class CoverageCarpet {
 public:
  CoverageCarpet(vtkRenderer& renderer, double outline_px);
  ~CoverageCarpet();

  /// Lays the carpet anew where the grid has changed, dyes it anew where levels have; else costs a
  /// comparison. A grid without as many levels as cells is not shown.
  void update(const std::optional<CoverageGrid>& grid, bool visible);
  bool visible() const { return outline_.visible(); }

 private:
  void lay(const CoverageGrid& grid);
  void dye(const CoverageGrid& grid);

  PictureSheet carpet_;
  EdgedLines outline_;
  std::optional<CoverageGrid> drawn_;
};

}  // namespace palpa::scene

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
    return carpet_.visible() || map_.visible() || lead_.visible() ||
           (balls_.any() && !balls_above_);
  }
  bool anyAbove() const { return pins_.any() || (balls_.any() && balls_above_); }

 private:
  void showLead(const SceneState& state, bool visible, const Sight& sight);

  MapCarpet map_;
  CoverageCarpet carpet_;
  EdgedLines lead_;
  LumpBalls balls_;
  Pins pins_;
  Pose lead_at_ = Pose::Identity();
  bool lead_drawn_ = false;
  bool balls_above_ = false;
};

}  // namespace palpa::scene
