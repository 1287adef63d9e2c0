#include "scene/actors/force_arrows.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>

#include "scene/actors/instrument.h"
#include "scene/actors/mesh_builder.h"

namespace palpa::scene {
namespace {

/// Along +z from the origin, `length` long; grown outward by `rim` on all sides.
vtkSmartPointer<vtkPolyData> arrowShape(double length, double unit, double rim, const Rgb& colour) {
  const double shaft = 0.5 * unit + rim, head = 1.35 * unit + 1.3 * rim;
  const double neck = std::max(0.0, length - 3.2 * unit) - rim;
  MeshBuilder builder;
  builder.turn({{0, length + 2 * rim}, {head, neck}, {shaft, neck}, {shaft, -rim}, {0, -rim}},
               colour, 16);
  return builder.mesh();
}

}  // namespace

struct ForceArrows::Arrow {
  explicit Arrow(vtkRenderer& renderer) {
    for (vtkActor* actor : {body_actor.Get(), rim_actor.Get()}) {
      actor->SetUserMatrix(X_A_arrow);
      renderer.AddActor(actor);
    }
    body_actor->SetMapper(body);
    body_actor->GetProperty()->SetAmbient(0.65);  // grays must stay the grays of the legend
    body_actor->GetProperty()->SetDiffuse(0.35);
    rim_actor->SetMapper(rim);
    rim_actor->GetProperty()->LightingOff();
    rim_actor->GetProperty()->FrontfaceCullingOn();  // only the hull behind the body remains
  }
  void show(bool visible) {
    body_actor->SetVisibility(visible);
    rim_actor->SetVisibility(visible);
  }

  vtkNew<vtkActor> body_actor, rim_actor;
  vtkNew<vtkPolyDataMapper> body, rim;
  vtkNew<vtkMatrix4x4> X_A_arrow;
};

ForceArrows::ForceArrows(vtkRenderer& renderer, ForceColours colours)
    : renderer_(renderer), colours_(colours) {}
ForceArrows::~ForceArrows() = default;

void ForceArrows::update(const std::vector<ForceArrow>& forces, const Pose& X_CA, double focal_px,
                         double unit_px) {
  shown_ = 0;
  for (const ForceArrow& force : forces) {
    const double newtons = force.f_A.norm();
    if (!(newtons >= kWeakest)) continue;
    if (shown_ == arrows_.size()) arrows_.push_back(std::make_unique<Arrow>(renderer_));
    Arrow& arrow = *arrows_[shown_++];
    const double depth = std::max(0.05, (X_CA * force.p_A).z());
    const double unit = unit_px * depth / focal_px, rim = 0.30 * unit;
    const double length = kMetresPerNewton * std::min(newtons, kLongest);
    arrow.body->SetInputData(arrowShape(length, unit, 0, arrowColour(force.kind, colours_)));
    arrow.rim->SetInputData(arrowShape(length, unit, rim, arrowOutline(force.kind)));
    const Vec3 way = force.f_A / newtons;
    copy(makePose(rotationWithZ(way), force.p_A + kGap * unit * way), *arrow.X_A_arrow);
    arrow.show(true);
  }
  for (std::size_t i = shown_; i < arrows_.size(); ++i) arrows_[i]->show(false);
}

bool ForceArrows::any() const { return shown_ > 0; }

Rgb arrowColour(ForceKind kind, ForceColours colours) {
  const bool safe = colours == ForceColours::safe;
  switch (kind) {
    case ForceKind::reaction:
      return safe ? Rgb{0.835, 0.369, 0.000} : Rgb{0.22, 0.22, 0.22};  // vermilion
    case ForceKind::weight:
    case ForceKind::friction:
      return safe ? Rgb{0.337, 0.706, 0.914} : Rgb{0.50, 0.50, 0.50};  // sky blue
    case ForceKind::felt:
      return {1, 1, 1};
    case ForceKind::device:
      break;
  }
  return safe ? Rgb{0.941, 0.894, 0.259} : Rgb{0.86, 0.86, 0.86};  // yellow
}

Rgb arrowOutline(ForceKind kind) {
  if (kind == ForceKind::device || kind == ForceKind::felt) return {0.08, 0.08, 0.08};
  return {0.97, 0.97, 0.97};
}

const char* name(ForceKind kind) {
  switch (kind) {
    case ForceKind::reaction:
      return "reaction";
    case ForceKind::weight:
      return "weight";
    case ForceKind::friction:
      return "friction";
    case ForceKind::felt:
      return "felt";
    case ForceKind::device:
      break;
  }
  return "device";
}

}  // namespace palpa::scene
