#include "apps/bench/point_locators.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include "anatomy/query/triangle_tree.h"

namespace palpa::bench {
namespace {

class OurLocator final : public PointLocator {
 public:
  explicit OurLocator(const anatomy::TriangleMesh& mesh) : tree_(mesh) {}
  std::string name() const override { return "palpa"; }
  Vec3 closest(const Vec3& p) override { return tree_.closest(p).p; }

 private:
  anatomy::TriangleTree tree_;
};

class VtkLocator final : public PointLocator {
 public:
  explicit VtkLocator(const anatomy::TriangleMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3& p : mesh.points) points->InsertNextPoint(p.data());
    vtkNew<vtkCellArray> triangles;
    for (const auto& t : mesh.triangles) {
      const vtkIdType corners[] = {t[0], t[1], t[2]};
      triangles->InsertNextCell(3, corners);
    }
    data_->SetPoints(points);
    data_->SetPolys(triangles);
    locator_->SetDataSet(data_);
    locator_->BuildLocator();
  }
  std::string name() const override { return "vtkStaticCellLocator"; }
  Vec3 closest(const Vec3& p) override {
    Vec3 found = Vec3::Zero();
    vtkIdType cell = 0;
    int part = 0;
    double squared = 0;
    locator_->FindClosestPoint(p.data(), found.data(), cell_, cell, part, squared);
    return found;
  }

 private:
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkStaticCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
};

}  // namespace

std::unique_ptr<PointLocator> ourLocator(const anatomy::TriangleMesh& mesh) {
  return std::make_unique<OurLocator>(mesh);
}
std::unique_ptr<PointLocator> vtkLocator(const anatomy::TriangleMesh& mesh) {
  return std::make_unique<VtkLocator>(mesh);
}

}  // namespace palpa::bench
