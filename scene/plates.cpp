#include "scene/plates.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::scene {

Plates::Plates(vtkRenderer& renderer) {
  vtkNew<vtkCoordinate> pixels;
  pixels->SetCoordinateSystemToViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shapes_);
  mapper->SetTransformCoordinate(pixels);
  mapper->SetScalarModeToUseCellData();
  actor_->SetMapper(mapper);
  actor_->SetLayerNumber(0);
  renderer.AddActor2D(actor_);
  clear();
}

Plates::~Plates() = default;

void Plates::clear() {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  shapes_->SetPoints(points);
  shapes_->SetPolys(polygons);
  shapes_->GetCellData()->SetScalars(colours);
}

void Plates::setVisible(bool visible) { actor_->SetVisibility(visible); }

void Plates::add(const Rect& where, const Rgba& colour, int corner_px) {
  constexpr int kSteps = 5;
  const double r = std::min({corner_px, where.width / 2, where.height / 2});
  const double centres[4][2] = {{where.right() - r, where.top() - r},
                                {where.x + r, where.top() - r},
                                {where.x + r, where.y + r},
                                {where.right() - r, where.y + r}};
  vtkCellArray* polygons = shapes_->GetPolys();
  polygons->InsertNextCell(4 * (kSteps + 1));
  for (int corner = 0; corner < 4; ++corner) {
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = 0.5 * std::numbers::pi * (corner + static_cast<double>(i) / kSteps);
      polygons->InsertCellPoint(shapes_->GetPoints()->InsertNextPoint(
          centres[corner][0] + r * std::cos(angle), centres[corner][1] + r * std::sin(angle), 0));
    }
  }
  auto* colours = vtkUnsignedCharArray::SafeDownCast(shapes_->GetCellData()->GetScalars());
  colours->InsertNextTuple4(255 * colour[0], 255 * colour[1], 255 * colour[2], 255 * colour[3]);
  shapes_->GetPoints()->Modified();
  shapes_->Modified();
}

}  // namespace palpa::scene
