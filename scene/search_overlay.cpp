#include "scene/search_overlay.h"

#include <cmath>
#include <numbers>

namespace palpa::scene {
namespace {

constexpr double kLeadRadius = 0.010;  // m: a fingertip stands in it
constexpr double kLeadTick = 0.004;
constexpr double kLeadLift = 0.001;  // toward the viewer, off the surface

/// A ring about the origin, and four ticks that point to its middle.
std::vector<std::vector<Vec3>> leadShape(const Pose& X_A) {
  constexpr int kSteps = 48;
  const auto at = [&](double radius, double share) {
    const double angle = 2 * std::numbers::pi * share;
    return Vec3(X_A * Vec3(radius * std::cos(angle), radius * std::sin(angle), 0));
  };
  std::vector<std::vector<Vec3>> lines(1);
  for (int i = 0; i <= kSteps; ++i)
    lines[0].push_back(at(kLeadRadius, static_cast<double>(i) / kSteps));
  for (const double share : {0.0, 0.25, 0.5, 0.75})
    lines.push_back({at(kLeadRadius, share), at(kLeadRadius + kLeadTick, share)});
  return lines;
}

}  // namespace

SearchOverlay::SearchOverlay(vtkRenderer& on_skin, vtkRenderer& above, double line_px)
    : carpet_(on_skin, 0.6 * line_px),
      lead_(on_skin, colour::kText, line_px),
      balls_(on_skin, above, 0.9 * line_px),
      pins_(above) {}

SearchOverlay::~SearchOverlay() = default;

// In the plane of what is searched, where that is known; else toward the eye.
void SearchOverlay::showLead(const SceneState& state, bool visible, const Sight& sight) {
  if (!visible || !state.lead_A) return lead_.hide();
  const Mat3 R = state.coverage ? Mat3(state.coverage->X_AG.linear()) : sight.facing();
  const Pose at = makePose(R, *state.lead_A + kLeadLift * R.col(2));
  if (lead_drawn_ && at.matrix() == lead_at_.matrix()) return lead_.setVisible(true);
  lead_.show(leadShape(at));
  lead_at_ = at;
  lead_drawn_ = true;
}

void SearchOverlay::update(const SceneState& state, bool visible, const Sight& sight,
                           double pin_px) {
  balls_above_ = state.skin == SkinStyle::solid;
  carpet_.update(state.coverage, visible);
  balls_.update(visible ? state.lumps : std::vector<Lump>(), sight, balls_above_);
  pins_.update(visible ? state.marks_A : std::vector<Vec3>(), sight, pin_px);
  showLead(state, visible, sight);
}

}  // namespace palpa::scene
