#pragma once

#include "scene/actors/lines.h"
#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// A needle is thinner than a pixel or two where a whole patient is seen: its axis as a line that
/// keeps a least width on the screen, pale with dark edges outside, tinted under the skin, where
/// translucent skin shows it. Nothing where the needle itself is drawn wide enough. Where a bone or
/// another organ hides what is inside, it is dashed, as what is hidden is in a drawing.
class NeedleLine {
 public:
  /// `on_skin`: its lines are hidden by what is opaque and nearer.
  explicit NeedleLine(vtkRenderer& on_skin);

  /// `entry_A`: where it went through the skin; none: all of it is outside. `focal_px`: pixels of
  /// the window at unit depth; `unit_px`: a 720th of the window's height; `soft_px`: how wide the
  /// overlay will be blurred: the line is wider by as much; `see_inside`: what is inside may be
  /// seen.
  void update(const SceneState& state, const std::optional<Vec3>& entry_A, const Pose& X_CA,
              double focal_px, double unit_px, double soft_px, bool see_inside);
  void hide();
  bool visible() const { return outside_.visible() || inside_.visible() || hidden_.visible(); }

 private:
  EdgedLines hidden_, outside_, inside_;  // in the order of drawing
};

}  // namespace palpa::scene
