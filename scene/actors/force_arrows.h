#pragma once

#include <memory>
#include <vector>

#include "scene/palette.h"
#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// Force arrows after Jeon, Choi and Harders (2015, figure 10.7): reaction dark gray, weight mid
/// gray, device light gray; each has an outline of the opposite brightness, so that it is seen on
/// any background; or the other colours. The length is the force, the thickness is constant on the
/// screen.
class ForceArrows {
 public:
  static constexpr double kMetresPerNewton = 0.030;
  static constexpr double kLongest = 4;  ///< newtons; stronger forces are drawn as this
  /// Shaft widths between an arrow and what it acts on: a needle's tip is to be seen
  static constexpr double kGap = 1.6;
  static constexpr double kWeakest = 0.02;  ///< newtons; weaker ones are not drawn

  explicit ForceArrows(vtkRenderer& renderer, ForceColours colours = ForceColours::paper);
  ~ForceArrows();

  /// `focal_px`: the camera's focal length in window pixels; `unit_px` is the shaft's width on the
  /// screen.
  void update(const std::vector<ForceArrow>& forces, const Pose& X_CA, double focal_px,
              double unit_px);
  bool any() const;

 private:
  struct Arrow;
  vtkRenderer& renderer_;
  ForceColours colours_;
  std::vector<std::unique_ptr<Arrow>> arrows_;
  std::size_t shown_ = 0;
};

Rgb arrowColour(ForceKind kind, ForceColours colours);
Rgb arrowOutline(ForceKind kind);
const char* name(ForceKind kind);  ///< "device", "weight", "reaction", "felt"

}  // namespace palpa::scene
