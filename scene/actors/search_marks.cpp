#include "scene/actors/search_marks.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkVectorText.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "scene/actors/instrument.h"
#include "scene/actors/mesh_builder.h"
#include "scene/renderer_setup.h"

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
  void place(const ShownLump& lump, const Vec3& eye) {
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

void LumpBalls::update(const std::vector<ShownLump>& lumps, const Sight& sight, bool solid_skin) {
  shown_ = 0;
  for (const ShownLump& lump : lumps) {
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

namespace {

constexpr double kHead = 2.3;  // its middle over the point, in radii of the head
constexpr double kRim = 0.22;
constexpr double kStep = 0.01;  // between what lies upon each other, in radii

/// A drop: the point at the origin, its head of radius 1 above; grown by `rim`.
void addDrop(MeshBuilder& builder, double rim, double z, const Rgb& c) {
  constexpr int kSteps = 40;
  const double r = 1 + rim, tip = -1.6 * rim;
  // From where a line through the tip touches the head, round to where the other one does.
  const double half = std::numbers::pi - std::acos(r / (kHead - tip));
  const auto on = [&](int i) {
    const double angle = half * (2.0 * i / kSteps - 1);
    return Vec3(r * std::sin(angle), kHead + r * std::cos(angle), z);
  };
  const Vec3 middle(0, kHead, z), point(0, tip, z);
  for (int i = 0; i < kSteps; ++i) builder.triangle(middle, on(i + 1), on(i), c);
  builder.triangle(middle, point, on(kSteps), c);
  builder.triangle(middle, on(0), point, c);
}

/// Words of the given height, their middle at `middle`.
void addWords(MeshBuilder& builder, const std::string& words, double height, double widest,
              const Vec3& middle, const Rgb& c) {
  vtkNew<vtkVectorText> text;
  text->SetText(words.c_str());
  text->Update();
  vtkPolyData* shape = text->GetOutput();
  double b[6];
  shape->GetBounds(b);
  if (!(b[1] > b[0] && b[3] > b[2])) return;
  const double scale = std::min(height / (b[3] - b[2]), widest / (b[1] - b[0]));
  const Vec3 centre(0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3]), 0);
  vtkNew<vtkIdList> corners;
  const auto point = [&](vtkIdType i) {
    Vec3 p;
    shape->GetPoint(corners->GetId(i), p.data());
    return Vec3(middle + scale * (p - centre));
  };
  for (vtkIdType i = 0; i < shape->GetNumberOfCells(); ++i) {
    shape->GetCellPoints(i, corners);
    for (vtkIdType k = 2; k < corners->GetNumberOfIds(); ++k)
      builder.triangle(point(0), point(k - 1), point(k), c);
  }
}

vtkSmartPointer<vtkPolyData> pinShape(std::size_t number) {
  MeshBuilder builder;
  addDrop(builder, kRim, 0, colour::kPanel);
  addDrop(builder, 0, kStep, colour::kMark);
  addWords(builder, std::to_string(number), 1.15, 1.35, {0, kHead, 2 * kStep}, colour::kInk);
  return builder.mesh();
}

}  // namespace

struct Pins::Pin {
  Pin(vtkRenderer& renderer, std::size_t number) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(pinShape(number));
    actor->SetMapper(mapper);
    actor->SetUserMatrix(X_A);
    actor->GetProperty()->LightingOff();
    renderer.AddActor(actor);
  }
  vtkNew<vtkActor> actor;
  vtkNew<vtkMatrix4x4> X_A;
};

Pins::Pins(vtkRenderer& renderer) : renderer_(renderer) {}
Pins::~Pins() = default;

void Pins::update(const std::vector<Vec3>& places_A, const Sight& sight, double head_px) {
  const Mat3 R = sight.facing();
  while (pins_.size() < places_A.size())
    pins_.push_back(std::make_unique<Pin>(renderer_, pins_.size() + 1));
  shown_ = places_A.size();
  for (std::size_t i = 0; i < pins_.size(); ++i) {
    pins_[i]->actor->SetVisibility(i < shown_);
    if (i < shown_)
      copy(makePose(head_px * sight.metresPerPixel(places_A[i]) * R,
                    places_A[i] + sight.before * R.col(2)),
           *pins_[i]->X_A);
  }
}

}  // namespace palpa::scene
