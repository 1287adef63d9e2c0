#include "scene/pins.h"

#include <vtkActor.h>
#include <vtkIdList.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkVectorText.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "scene/instrument.h"
#include "scene/mesh_builder.h"

namespace palpa::scene {
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
