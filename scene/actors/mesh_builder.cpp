#include "scene/actors/mesh_builder.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <numbers>

namespace palpa::scene {

struct MeshBuilder::Data {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkUnsignedCharArray> colours;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkCellArray> lines;
};

MeshBuilder::MeshBuilder() : data_(std::make_unique<Data>()) {
  data_->normals->SetNumberOfComponents(3);
  data_->normals->SetName("Normals");
  data_->colours->SetNumberOfComponents(3);
  data_->colours->SetName("Colours");
}

MeshBuilder::~MeshBuilder() = default;

long MeshBuilder::addPoint(const Vec3& p, const Vec3& n, const Rgb& colour) {
  data_->normals->InsertNextTuple3(n.x(), n.y(), n.z());
  data_->colours->InsertNextTuple3(255 * colour[0], 255 * colour[1], 255 * colour[2]);
  return data_->points->InsertNextPoint(p.data());
}

void MeshBuilder::turn(std::initializer_list<ProfilePoint> profile, const Rgb& colour, int sides) {
  const ProfilePoint* previous = nullptr;
  for (const ProfilePoint& point : profile) {
    if (previous) band(*previous, point, colour, sides);
    previous = &point;
  }
}

void MeshBuilder::band(const ProfilePoint& a, const ProfilePoint& b, const Rgb& colour, int sides) {
  // Outward normal of the profile's segment: its tangent (dr, dz) turned to (-dz, dr).
  const double length = std::hypot(b.r - a.r, b.z - a.z);
  const double nr = -(b.z - a.z) / length, nz = (b.r - a.r) / length;
  long last_a = -1, last_b = -1;
  for (int i = 0; i <= sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec3 n(nr * c, nr * s, nz);
    const long at_a = addPoint({a.r * c, a.r * s, a.z}, n, colour);
    const long at_b = addPoint({b.r * c, b.r * s, b.z}, n, colour);
    if (i > 0) {
      const vtkIdType first[] = {last_a, last_b, at_b}, second[] = {last_a, at_b, at_a};
      data_->triangles->InsertNextCell(3, first);
      data_->triangles->InsertNextCell(3, second);
    }
    last_a = at_a;
    last_b = at_b;
  }
}

/// The part of a sphere that lies within an angle of its pole, which is toward +z.
void MeshBuilder::cap(double radius, const Vec3& centre, double to_pole_angle, const Rgb& colour,
                      int sides, int rings) {
  for (int i = 0; i <= rings; ++i) {
    const double from_pole = to_pole_angle * i / rings;
    for (int j = 0; j <= sides; ++j) {
      const double angle = 2 * std::numbers::pi * j / sides;
      const Vec3 n(std::sin(from_pole) * std::cos(angle), std::sin(from_pole) * std::sin(angle),
                   std::cos(from_pole));
      const long at = addPoint(centre + radius * n, n, colour);
      if (i == 0 || j == 0) continue;
      const vtkIdType above = at - sides - 1;
      const vtkIdType one[] = {above - 1, at - 1, at}, other[] = {above - 1, at, above};
      data_->triangles->InsertNextCell(3, one);
      data_->triangles->InsertNextCell(3, other);
    }
  }
}

void MeshBuilder::dome(double radius, double z, const Rgb& colour, int sides) {
  cap(radius, Vec3(0, 0, z - radius), std::numbers::pi / 2, colour, sides, sides / 3);
}

void MeshBuilder::ball(double radius, const Rgb& colour, int sides, const Vec3& centre) {
  cap(radius, centre, std::numbers::pi, colour, sides, sides / 2);
}

void MeshBuilder::arc(double r, double z, double middle, double half_angle, const Rgb& colour) {
  constexpr int kSteps = 10;
  data_->lines->InsertNextCell(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = middle + half_angle * (2.0 * i / kSteps - 1);
    const Vec3 n(std::cos(angle), std::sin(angle), 0);
    data_->lines->InsertCellPoint(addPoint({r * n.x(), r * n.y(), z}, n, colour));
  }
}

void MeshBuilder::triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Rgb& colour) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const vtkIdType corners[] = {addPoint(a, n, colour), addPoint(b, n, colour),
                               addPoint(c, n, colour)};
  data_->triangles->InsertNextCell(3, corners);
}

vtkSmartPointer<vtkPolyData> MeshBuilder::mesh() const {
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(data_->points);
  result->GetPointData()->SetNormals(data_->normals);
  result->GetPointData()->SetScalars(data_->colours);
  result->SetPolys(data_->triangles);
  if (data_->lines->GetNumberOfCells() > 0) result->SetLines(data_->lines);
  return result;
}

}  // namespace palpa::scene
