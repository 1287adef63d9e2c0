#include "scene/actors/instrument.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/actors/glass.h"
#include "scene/actors/mesh_builder.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

constexpr double kClear = 0.28;               // the barrel's opacity
constexpr double kUp = std::numbers::pi / 2;  // angle of +y, where the bevel opens

/// The ground tip: the tube cut by a plane through the tip point (at -y) and `bevel_length` behind
/// it (at +y), closed by a dark ellipse, the lumen.
void addBevel(MeshBuilder& builder, const InstrumentSize& size) {
  constexpr int kSides = 20;
  const auto rim = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const double y = std::sin(angle);
    return Vec3(size.needle_radius * std::cos(angle), size.needle_radius * y,
                -0.5 * size.bevel_length * (1 + y));
  };
  const Vec3 middle(0, 0, -0.5 * size.bevel_length);
  for (int i = 0; i < kSides; ++i) {
    const Vec3 a = rim(i), b = rim(i + 1);
    const Vec3 a_back(a.x(), a.y(), -size.bevel_length), b_back(b.x(), b.y(), -size.bevel_length);
    builder.triangle(a, a_back, b_back, colour::kSteel);
    builder.triangle(a, b_back, b, colour::kSteel);
    builder.triangle(a, b, middle, colour::kLumen);
  }
}

/// Twelve marks, one a millilitre, long ones at 0, 5 and 10.
void addScale(MeshBuilder& builder, const InstrumentSize& size) {
  constexpr int kMillilitres = 12;
  const double r = size.barrel_radius * 1.01;
  for (int ml = 0; ml <= kMillilitres; ++ml) {
    const double z = size.barrel_front - size.stroke * ml / kMillilitres;
    builder.arc(r, z, kUp, ml % 5 == 0 ? 0.85 : 0.45, colour::kInk);
  }
}

void addHub(MeshBuilder& builder, const InstrumentSize& size) {
  const double z = -size.needle_length;
  builder.turn({{0.0006, z}, {0.0017, z - 0.0005}, {0.0023, z - 0.006}}, colour::kHub);
  builder.turn({{0.0030, z - 0.006}, {0.0034, z - 0.013}, {0.0038, z - 0.013}, {0.0038, z - 0.016}},
               colour::kHub);
}

}  // namespace

vtkSmartPointer<vtkPolyData> needleShape(const InstrumentSize& size) {
  MeshBuilder builder;
  addBevel(builder, size);
  builder.turn(
      {{size.needle_radius, -size.bevel_length}, {size.needle_radius, -size.needle_length}},
      colour::kSteel, 16);
  addHub(builder, size);
  addScale(builder, size);
  return builder.mesh();
}

vtkSmartPointer<vtkPolyData> barrelShape(const InstrumentSize& size) {
  const double front = size.barrel_front, back = front - size.barrel_length;
  const double r = size.barrel_radius;
  MeshBuilder builder;
  builder.turn({{0.0020, -size.needle_length - 0.016},
                {0.0024, front + 0.002},
                {r, front},
                {r, back},
                {0.0125, back},
                {0.0125, back - 0.0022},
                {size.bore_radius, back - 0.0022}},
               colour::kGlass, 32);
  return builder.mesh();
}

vtkSmartPointer<vtkPolyData> plungerShape(const InstrumentSize& size) {
  const double front = size.barrel_front, bore = size.bore_radius * 0.985;
  const double end = front - size.barrel_length - 0.012;
  MeshBuilder builder;
  builder.turn(
      {{0, front + 0.0008}, {bore, front}, {bore, front - 0.0065}, {0.0030, front - 0.0065}},
      colour::kRubber);
  builder.turn({{0.0032, front - 0.0065}, {0.0032, end}}, colour::kPlastic, 16);
  builder.turn({{0.0032, end}, {0.0100, end}, {0.0100, end - 0.0022}, {0, end - 0.0022}},
               colour::kPlastic);
  return builder.mesh();
}

vtkSmartPointer<vtkPolyData> bloodShape(const InstrumentSize& size) {
  const double r = size.bore_radius * 0.97;
  MeshBuilder builder;
  builder.turn({{0, 0}, {r, 0}, {r, -1}, {0, -1}}, colour::kBlood);
  return builder.mesh();
}

vtkSmartPointer<vtkPolyData> bubblesShape(const InstrumentSize& size) {
  constexpr double kBehind[] = {0.003, 0.008, 0.0105, 0.016};  // m from the bore's front
  constexpr double kRadius[] = {0.0026, 0.0018, 0.0034, 0.0024};
  const double rises = 0.5 * size.bore_radius;
  MeshBuilder builder;
  for (std::size_t i = 0; i < std::size(kBehind); ++i)
    builder.ball(kRadius[i], colour::kAir, 12,
                 Vec3((i % 2 ? 0.4 : -0.3) * rises, rises, size.barrel_front - kBehind[i]));
  return builder.mesh();
}

vtkSmartPointer<vtkPolyData> probeShape(const ProbeSize& size) {
  const double r = size.tip_radius, shaft = size.shaft_radius, handle = size.handle_radius;
  const double neck = -1.6 * r, end = size.handle_end;
  MeshBuilder builder;
  builder.dome(r, 0, colour::kTip, 32);
  builder.turn({{r, -r}, {r, neck}, {0.94 * r, neck - 0.001}, {shaft, neck - 0.005}}, colour::kTip,
               32);
  builder.turn({{shaft, neck - 0.005}, {shaft, size.shaft_end}}, colour::kSteel);
  builder.turn({{shaft, size.shaft_end},
                {handle, size.shaft_end - 0.006},
                {handle, end + 0.003},
                {handle - 0.003, end},
                {0, end}},
               colour::kRubber);
  return builder.mesh();
}

vtkSmartPointer<vtkPolyData> silhouetteShape(const InstrumentSize& size) {
  const double front = size.barrel_front, back = front - size.barrel_length;
  MeshBuilder builder;
  builder.turn({{0, 0}, {size.needle_radius, -0.001}, {size.needle_radius, -size.needle_length}},
               colour::kPlastic, 12);
  addHub(builder, size);
  builder.turn({{0.0026, front + 0.004}, {size.barrel_radius, front}, {size.barrel_radius, back}},
               {0.48, 0.54, 0.60});
  return builder.mesh();
}

namespace {

void dress(
    vtkActor& actor, const vtkSmartPointer<vtkPolyData>& mesh, double specular,
    const vtkSmartPointer<vtkPolyDataMapper>& mapper = vtkSmartPointer<vtkPolyDataMapper>::New()) {
  mapper->SetInputData(mesh);
  actor.SetMapper(mapper);
  actor.GetProperty()->SetAmbient(0.22);
  actor.GetProperty()->SetDiffuse(0.78);
  actor.GetProperty()->SetSpecular(specular);
  actor.GetProperty()->SetSpecularPower(40);
}

Pose shifted(const Pose& X, double z) { return X * Eigen::Translation3d(0, 0, z); }

}  // namespace

void copy(const Pose& X, vtkMatrix4x4& matrix) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix.SetElement(row, column, X(row, column));
}

Instrument::Instrument(vtkRenderer& renderer, Glass* glass) {
  dress(*needle_, needleShape(size_), 0.45);
  dress(*barrel_, barrelShape(size_), 0.6, makePassMapper());
  dress(*plunger_, plungerShape(size_), 0.2);
  dress(*blood_, bloodShape(size_), 0.3);
  blood_->GetMapper()->ScalarVisibilityOff();  // whose it is says the actor's colour
  dress(*bubbles_, bubblesShape(size_), 0.8);
  dress(*probe_, probeShape({}), 0.35);
  barrel_->GetProperty()->SetOpacity(kClear);
  needle_->GetProperty()->SetLineWidth(1.5);
  needle_->SetUserMatrix(X_AT_);
  barrel_->SetUserMatrix(X_AT_);
  bubbles_->SetUserMatrix(X_AT_);
  probe_->SetUserMatrix(X_AT_);
  plunger_->SetUserMatrix(X_A_plunger_);
  blood_->SetUserMatrix(X_A_blood_);
  for (vtkActor* actor : actors())
    if (!glass || actor != barrel_.Get()) renderer.AddActor(actor);
  if (glass) glass->addBefore(barrel_);
}

Instrument::~Instrument() = default;

std::array<vtkActor*, 6> Instrument::actors() const {
  return {needle_, plunger_, blood_, bubbles_, probe_, barrel_};
}

void Instrument::update(const Pose& X_AT, double plunger, double blood, Tissue of) {
  const double drawn = std::clamp(plunger, 0.0, 1.0) * size_.stroke;
  const double column = std::min(std::clamp(blood, 0.0, 1.0) * size_.stroke, drawn);
  has_blood_ = column > 1e-4;
  has_bubbles_ = of == Tissue::lung;
  const Rgb& colour = of == Tissue::artery_lumen ? colour::kArterialBlood : colour::kBlood;
  blood_->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  copy(X_AT, *X_AT_);
  copy(shifted(X_AT, -drawn), *X_A_plunger_);
  copy(shifted(X_AT, size_.barrel_front), *X_A_blood_);
  for (int row = 0; row < 3; ++row)
    X_A_blood_->SetElement(row, 2, column * X_A_blood_->GetElement(row, 2));
}

void Instrument::show(Tool tool) {
  const bool needle = tool == Tool::needle;
  for (vtkActor* actor : {needle_.Get(), plunger_.Get(), barrel_.Get()})
    actor->SetVisibility(needle);
  blood_->SetVisibility(needle && has_blood_);
  bubbles_->SetVisibility(needle && has_bubbles_);
  probe_->SetVisibility(tool == Tool::probe);
}

void Instrument::hide() {
  for (vtkActor* actor : actors()) actor->VisibilityOff();
}

InstrumentSilhouette::InstrumentSilhouette(vtkRenderer& renderer) {
  dress(*needle_, silhouetteShape({}), 0.1);
  dress(*probe_, probeShape({}), 0.1);
  for (vtkActor* actor : {needle_.Get(), probe_.Get()}) {
    actor->GetProperty()->SetAmbient(0.5);
    actor->GetProperty()->SetDiffuse(0.5);
    actor->SetUserMatrix(X_AT_);
    renderer.AddActor(actor);
  }
  show(Tool::needle);
}

InstrumentSilhouette::~InstrumentSilhouette() = default;

void InstrumentSilhouette::update(const Pose& X_AT) { copy(X_AT, *X_AT_); }

void InstrumentSilhouette::show(Tool tool) {
  needle_->SetVisibility(tool == Tool::needle);
  probe_->SetVisibility(tool == Tool::probe);
}

void InstrumentSilhouette::hide() {
  needle_->VisibilityOff();
  probe_->VisibilityOff();
}

}  // namespace palpa::scene
