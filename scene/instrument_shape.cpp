#include "scene/instrument_shape.h"

#include <vtkPolyData.h>

#include <cmath>
#include <numbers>

#include "scene/mesh_builder.h"

namespace palpa::scene {
namespace {

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

}  // namespace palpa::scene
