#include "scene/actors/lines.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/geometry/dense_solvers.h"
#include "scene/palette.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {

EdgedLines::EdgedLines(vtkRenderer& renderer, const Rgb& colour, double width_px)
    : mapper_(makePassMapper()) {
  mapper_->SetInputData(shape_);
  const Rgb dark = colour::kPanel;
  const auto set = [&](vtkActor* actor, const Rgb& c) {
    actor->SetMapper(mapper_);
    actor->GetProperty()->SetColor(c[0], c[1], c[2]);
    actor->GetProperty()->LightingOff();
    actor->VisibilityOff();
    renderer.AddActor(actor);
  };
  set(edge_, dark);
  set(line_, colour);  // later and as near: over its edge
  setWidth(width_px);
}

void EdgedLines::setWidth(double width_px, double edge_px) {
  edge_->GetProperty()->SetLineWidth(static_cast<float>(width_px + 2 * edge_px));
  line_->GetProperty()->SetLineWidth(static_cast<float>(width_px));
}

EdgedLines::~EdgedLines() = default;

void EdgedLines::show(const std::vector<std::vector<Vec3>>& lines_A) {
  setVisible(!lines_A.empty());
  if (lines_A == shown_A_) return;
  shown_A_ = lines_A;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines_A) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const Vec3& p : line) cells->InsertCellPoint(points->InsertNextPoint(p.data()));
  }
  shape_->SetPoints(points);
  shape_->SetLines(cells);
}

void EdgedLines::drawThrough() {
  setWrites(*mapper_, true, false);
  for (vtkActor* actor : {edge_.Get(), line_.Get()})
    actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Depth::Impl", true,
                                                             "gl_FragDepth = 0.0;\n", false);
}

void EdgedLines::hide() { setVisible(false); }

void EdgedLines::setVisible(bool visible) {
  edge_->SetVisibility(visible);
  line_->SetVisibility(visible);
}

bool EdgedLines::visible() const { return line_->GetVisibility() != 0; }

std::vector<Vec3> uncertaintyEllipse(const Mat3& covariance_A, const Vec3& p_A, const Pose& X_CA,
                                     const Pinhole& camera, double least_px) {
  constexpr double kChi2_2_95 = 5.991;
  constexpr int kCorners = 64;
  const Vec3 p = X_CA * p_A;
  if (!(p.z() > 0)) return {};
  Eigen::Matrix<double, 2, 3> J;
  J << camera.fx / p.z(), 0, -camera.fx * p.x() / (p.z() * p.z()), 0, camera.fy / p.z(),
      -camera.fy * p.y() / (p.z() * p.z());
  const Mat3 S_C = X_CA.linear() * covariance_A * X_CA.linear().transpose();
  const SymmetricEigen<2> spread = symmetricEigen(Eigen::Matrix2d(J * S_C * J.transpose()));
  const Eigen::Vector2d half = (kChi2_2_95 * spread.values.cwiseMax(0)).cwiseSqrt();
  if (!(half[1] >= least_px)) return {};
  std::vector<Vec3> ellipse;
  for (int i = 0; i <= kCorners; ++i) {
    const double round = 2 * std::numbers::pi * i / kCorners;
    const Eigen::Vector2d px =
        spread.vectors * half.cwiseProduct(Eigen::Vector2d(std::cos(round), std::sin(round)));
    ellipse.push_back(X_CA.inverse() *
                      (p + p.z() * Vec3(px.x() / camera.fx, px.y() / camera.fy, 0)));
  }
  return ellipse;
}

std::vector<std::vector<Vec3>> dashes(const Vec3& from, const Vec3& to) {
  constexpr double kDash = 0.005, kGap = 0.003;
  const double length = (to - from).norm();
  std::vector<std::vector<Vec3>> all;
  for (double at = 0; at < length; at += kDash + kGap) {
    const double end = std::min(at + kDash, length);
    all.push_back({from + at / length * (to - from), from + end / length * (to - from)});
  }
  return all;
}

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
