#include "scene/lump_balls.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <array>
#include <cmath>
#include <numbers>

#include "scene/instrument.h"
#include "scene/mesh_builder.h"
#include "scene/pass_mapper.h"

namespace palpa::scene {
namespace {

constexpr double kBallOpacity = 0.50;
constexpr double kRingEdge_px = 2;  // by which the dark edge is wider than the ring

/// A circle of radius 1 about z, whole or in dashes.
vtkSmartPointer<vtkPolyData> circleShape(bool dashed) {
  constexpr int kSteps = 72, kDash = 4, kPeriod = 6;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  const auto point = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    return points->InsertNextPoint(std::cos(angle), std::sin(angle), 0);
  };
  for (int from = 0; from < kSteps; from += dashed ? kPeriod : kSteps) {
    const int count = (dashed ? kDash : kSteps) + 1;
    lines->InsertNextCell(count);
    for (int i = 0; i < count; ++i) lines->InsertCellPoint(point(from + i));
  }
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(points);
  shape->SetLines(lines);
  return shape;
}

Pose scaledPose(const Mat3& R, const Vec3& p, double scale) { return makePose(scale * R, p); }

void dye(vtkActor& actor, const Rgb& c) { actor.GetProperty()->SetColor(c[0], c[1], c[2]); }

}  // namespace

struct LumpBalls::LumpBall {
  LumpBall(vtkRenderer& renderer, vtkPolyData* sphere, double ring_px) : where(&renderer) {
    const vtkSmartPointer<vtkPolyDataMapper> mapper = makePassMapper();
    mapper->SetInputData(sphere);
    mapper->ScalarVisibilityOff();
    setWrites(*mapper, true, false);  // its own outline lies partly behind it
    ball->SetMapper(mapper);
    ball->ForceOpaqueOn();
    ball->SetUserMatrix(X_A_ball);
    ball->GetProperty()->SetOpacity(kBallOpacity);
    ball->GetProperty()->BackfaceCullingOn();
    ball->GetProperty()->SetAmbient(0.55);
    ball->GetProperty()->SetDiffuse(0.50);
    for (vtkActor* actor : {edge.Get(), ring.Get()}) {
      actor->SetMapper(outline);
      actor->SetUserMatrix(X_A_ring);
      actor->GetProperty()->LightingOff();
    }
    edge->GetProperty()->SetLineWidth(static_cast<float>(ring_px + kRingEdge_px));
    ring->GetProperty()->SetLineWidth(static_cast<float>(ring_px));
    dye(*edge, colour::kPanel);
    for (vtkActor* actor : actors()) where->AddActor(actor);
  }
  std::array<vtkActor*, 3> actors() { return {ball, edge, ring}; }
  void show(bool visible) {
    for (vtkActor* actor : actors()) actor->SetVisibility(visible);
  }
  void moveTo(vtkRenderer& renderer) {
    if (where == &renderer) return;
    for (vtkActor* actor : actors()) {
      where->RemoveActor(actor);
      renderer.AddActor(actor);
    }
    where = &renderer;
  }
  void outlineBy(vtkPolyData* shape) {
    if (outline->GetInput() != shape) outline->SetInputData(shape);
  }
  /// The outline of a sphere seen from d away is a circle of r sqrt(1 - r^2 / d^2), r^2 / d before
  /// its middle.
  void place(const Lump& lump, const Vec3& eye) {
    const Vec3 toward = eye - lump.p_A;
    const double d = toward.norm(), r = lump.radius, s = r / d;
    copy(scaledPose(Mat3::Identity(), lump.p_A, r), *X_A_ball);
    if (s < 1)
      copy(scaledPose(rotationWithZ(toward / d), lump.p_A + s * r * toward / d,
                      r * std::sqrt(1 - s * s)),
           *X_A_ring);
  }

  vtkRenderer* where;
  vtkNew<vtkActor> ball, edge, ring;
  vtkNew<vtkPolyDataMapper> outline;
  vtkNew<vtkMatrix4x4> X_A_ball, X_A_ring;
};

LumpBalls::LumpBalls(vtkRenderer& through, vtkRenderer& above, double ring_px)
    : through_(through),
      above_(above),
      ring_px_(ring_px),
      ring_(circleShape(false)),
      dashes_(circleShape(true)) {
  MeshBuilder builder;
  builder.ball(1, colour::kFound, 40);
  sphere_ = builder.mesh();
}

LumpBalls::~LumpBalls() = default;

void LumpBalls::update(const std::vector<Lump>& lumps, const Sight& sight, bool solid_skin) {
  shown_ = 0;
  for (const Lump& lump : lumps) {
    if (!(lump.radius > 0)) continue;
    if (shown_ == balls_.size())
      balls_.push_back(std::make_unique<LumpBall>(through_, sphere_, ring_px_));
    LumpBall& ball = *balls_[shown_++];
    ball.moveTo(solid_skin ? above_ : through_);
    const Rgb& look = lump.normal ? colour::kNormal : lump.found ? colour::kFound : colour::kMissed;
    ball.outlineBy(lump.found || lump.normal ? ring_ : dashes_);
    dye(*ball.ball, look);
    dye(*ball.ring, look);
    ball.place(lump, sight.eye());
    ball.show(true);
  }
  for (std::size_t i = shown_; i < balls_.size(); ++i) balls_[i]->show(false);
}

}  // namespace palpa::scene
