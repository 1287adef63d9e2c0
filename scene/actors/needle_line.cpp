#include "scene/actors/needle_line.h"

#include <algorithm>

#include "scene/actors/instrument.h"
#include "scene/palette.h"

namespace palpa::scene {
namespace {

constexpr double kLeast = 2.2, kWideEnough = 5, kEdge = 1.5, kThin = 1.4,
                 kThinEdge = 0.8;  // units of the screen

/// In front of the needle's own surface.
Vec3 toward(const Vec3& eye_A, const Vec3& p_A) {
  return p_A + 2 * InstrumentSize().needle_radius * (eye_A - p_A).normalized();
}

void show(EdgedLines& line, const Vec3& eye_A, const Vec3& from_A, const Vec3& to_A) {
  if ((to_A - from_A).norm() < 1e-6) return line.hide();
  line.show({{toward(eye_A, from_A), toward(eye_A, to_A)}});
}

}  // namespace

NeedleLine::NeedleLine(vtkRenderer& on_skin)
    : hidden_(on_skin, colour::kNeedleInside, kThin),
      outside_(on_skin, colour::kNeedle, kLeast),
      inside_(on_skin, colour::kNeedleInside, kLeast) {
  hidden_.drawThrough();
}

void NeedleLine::hide() {
  outside_.hide();
  inside_.hide();
  hidden_.hide();
}

void NeedleLine::update(const SceneState& state, const std::optional<Vec3>& entry_A,
                        const Pose& X_CA, double focal_px, double unit_px, double soft_px,
                        bool see_inside) {
  const InstrumentSize size;
  hidden_.hide();
  const Vec3 tip_A = state.X_AT.translation(), hub_A = state.X_AT * Vec3(0, 0, -size.needle_length);
  const double depth = std::max((X_CA * hub_A).z(), 1e-3);
  if (entry_A && see_inside) {
    hidden_.setWidth(kThin * unit_px + soft_px, kThinEdge * unit_px + soft_px);
    hidden_.show(dashes(tip_A, *entry_A));
  }
  const double drawn_px = 2 * size.needle_radius * focal_px / depth;
  if (drawn_px > kWideEnough * unit_px) {
    outside_.hide();
    return inside_.hide();
  }
  const double width_px = std::max(drawn_px, kLeast * unit_px + soft_px);
  for (EdgedLines* line : {&outside_, &inside_})
    line->setWidth(width_px, kEdge * unit_px + soft_px);
  const Vec3 eye_A = X_CA.inverse().translation();
  show(outside_, eye_A, entry_A.value_or(tip_A), hub_A);
  show(inside_, eye_A, tip_A, entry_A.value_or(tip_A));
}

}  // namespace palpa::scene
