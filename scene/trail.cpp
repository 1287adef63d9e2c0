#include "scene/trail.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "scene/palette.h"

namespace palpa::scene {

namespace {
constexpr double kTrailStep = 0.0002;  // metres; finer than a pixel at any working distance
}

Trail::Trail() { update({}); }
Trail::~Trail() = default;

vtkSmartPointer<vtkActor> Trail::addTo(vtkRenderer& renderer, double width_px) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(line_);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  Rgb colour = colour::kTrail;
  actor->GetProperty()->SetColor(colour.data());
  actor->GetProperty()->SetLineWidth(static_cast<float>(width_px));
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
  return actor;
}

void Trail::update(const std::vector<Vec3>& path_A) {
  const Vec3 end = path_A.empty() ? Vec3::Zero().eval() : path_A.back();
  if (line_->GetPoints() && path_A.size() == drawn_ && end == last_A_) return;
  drawn_ = path_A.size();
  last_A_ = end;
  vtkNew<vtkPoints> points;
  Vec3 previous = Vec3::Constant(1e9);
  for (const Vec3& p : path_A) {
    if ((p - previous).norm() < kTrailStep) continue;
    points->InsertNextPoint(p.data());
    previous = p;
  }
  vtkNew<vtkCellArray> cells;
  const vtkIdType count = points->GetNumberOfPoints();
  if (count > 1) {
    cells->InsertNextCell(static_cast<int>(count));
    for (vtkIdType i = 0; i < count; ++i) cells->InsertCellPoint(i);
  }
  line_->SetPoints(points);
  line_->SetLines(cells);
}

}  // namespace palpa::scene
