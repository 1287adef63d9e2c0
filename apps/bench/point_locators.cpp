#include "apps/bench/point_locators.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <cmath>
#include <limits>

#include "anatomy/query/triangle_tree.h"

#ifdef PALPA_WITH_EMBREE
#include <embree3/rtcore.h>

#include "anatomy/query/triangle_distance.h"
#endif

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

#ifdef PALPA_WITH_EMBREE
namespace {

class EmbreeLocator final : public PointLocator {
 public:
  explicit EmbreeLocator(const anatomy::TriangleMesh& mesh)
      : mesh_(mesh), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.points.size()));
    for (const Vec3& p : mesh.points)
      for (int axis = 0; axis < 3; ++axis) *points++ = static_cast<float>(p[axis]);
    auto* corners = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t corner : t) *corners++ = corner;
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
  }
  ~EmbreeLocator() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  std::string name() const override { return "Embree point query"; }
  Vec3 closest(const Vec3& p) override {
    Best best{mesh_, p, std::numeric_limits<double>::infinity(), Vec3::Zero()};
    RTCPointQuery query{static_cast<float>(p.x()), static_cast<float>(p.y()),
                        static_cast<float>(p.z()), 0, std::numeric_limits<float>::infinity()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, &EmbreeLocator::look, &best);
    return best.at;
  }

 private:
  struct Best {
    const anatomy::TriangleMesh& mesh;
    Vec3 p;
    double squared;
    Vec3 at;
  };
  static bool look(RTCPointQueryFunctionArguments* arguments) {
    auto& best = *static_cast<Best*>(arguments->userPtr);
    const auto& t = best.mesh.triangles[arguments->primID];
    const Vec3 &a = best.mesh.points[t[0]], &b = best.mesh.points[t[1]],
               &c = best.mesh.points[t[2]];
    const Vec3 w = anatomy::closestWeights(best.p, a, b, c), q = w[0] * a + w[1] * b + w[2] * c;
    const double squared = (q - best.p).squaredNorm();
    if (squared >= best.squared) return false;
    best.squared = squared;
    best.at = q;
    arguments->query->radius = static_cast<float>(std::sqrt(squared) * (1 + 1e-6));
    return true;  // the radius has changed
  }

  const anatomy::TriangleMesh& mesh_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

bool embreeIsThere() { return true; }
std::unique_ptr<PointLocator> embreeLocator(const anatomy::TriangleMesh& mesh) {
  return std::make_unique<EmbreeLocator>(mesh);
}

#else

bool embreeIsThere() { return false; }
std::unique_ptr<PointLocator> embreeLocator(const anatomy::TriangleMesh&) { return nullptr; }

#endif

}  // namespace palpa::bench
