#include "apps/bench/estimator_studies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "calibration/camera_calibration.h"
#include "calibration/rotation.h"

namespace palpa::bench {
namespace {

using namespace calibration;
using namespace study;

constexpr int kViews = 12, kColumns = 8, kRows = 6, kCorners = kColumns * kRows;
constexpr double kSquare = 0.025, kFound = 0.2;  // m, px

using Lens = Eigen::Matrix<double, kLensNumbers, 1>;

CameraModel cameraOf(const Lens& x) {
  return {640, 480, x[0], x[1], x[2], x[3], {x[4], x[5], x[6], x[7], x[8]}, 0};
}
Lens lensOf(const CameraModel& m) {
  const auto& k = m.distortion;
  return (Lens() << m.fx, m.fy, m.cx, m.cy, k[0], k[1], k[2], k[3], k[4]).finished();
}

Lens drawnLens(Random& random) {
  Lens x;
  x << 540, 540, 319.5, 239.5, -0.28, 0.09, 0, 0, -0.02;
  for (int k = 0; k < 4; ++k) x[k] += random.uniform(-10, 10);
  x[6] = random.uniform(-1e-3, 1e-3);
  x[7] = random.uniform(-1e-3, 1e-3);
  return x;
}

/// From the board's middle, so that it is turned about that.
Vec3 cornerAt(int i) {
  return kSquare * Vec3(i % kColumns - (kColumns - 1) / 2.0, i / kColumns - (kRows - 1) / 2.0, 0);
}

/// A hand holds the board so that all of it is seen.
Pose drawnPose(Random& random, const CameraModel& camera) {
  for (;;) {
    const double around = random.uniform(0, 2 * std::numbers::pi),
                 tilt = 45 * kDegree * std::sqrt(random.uniform()), z = random.uniform(0.25, 0.4);
    const Mat3 R = rotationOf(tilt * Vec3(std::cos(around), std::sin(around), 0)) *
                   rotationOf(random.uniform(-0.3, 0.3) * Vec3::UnitZ());
    Pose X_CW = makePose(R, z * Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), 1));
    bool seen = true;
    for (int i = 0; i < kCorners && seen; ++i) {
      const Eigen::Vector2d p = camera.project(X_CW * cornerAt(i));
      seen = p.x() > 0 && p.y() > 0 && p.x() < camera.width - 1 && p.y() < camera.height - 1;
    }
    if (seen) return X_CW;
  }
}

MatrixX boundOf(const Lens& x, const std::vector<Pose>& X_CW) {
  return cramerRaoBound(
      {kViews * kCorners, kLensNumbers + 6 * kViews,
       [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
         const auto v = static_cast<std::size_t>(i / kCorners);
         const Vec3 p = cornerAt(i % kCorners);
         const Pose moved_v =
             moved(X_CW[v], dx.segment<6>(kLensNumbers + 6 * static_cast<Eigen::Index>(v)));
         return cameraOf(x + dx.head<kLensNumbers>()).project(moved_v * p) -
                cameraOf(x).project(X_CW[v] * p) - e;
       },
       VectorX::Constant(2, kFound)});
}

}  // namespace

EstimateCheck cameraStudy(std::uint64_t seed, double outliers) {
  Random random(seed, "study.camera");
  const std::vector<bool> gross = grossErrors(random, kViews * kCorners, outliers);
  const Lens x = drawnLens(random);
  const CameraModel camera = cameraOf(x);
  std::vector<Pose> X_CW;
  std::vector<BoardView> views;
  for (int v = 0; v < kViews; ++v) {
    X_CW.push_back(drawnPose(random, camera));
    BoardView view{std::to_string(v + 1), {}, {}};
    for (int i = 0; i < kCorners; ++i) {
      view.p_W.push_back(cornerAt(i));
      const double du = random.normal(), dv = random.normal();
      view.pixels.push_back(camera.project(X_CW.back() * cornerAt(i)) +
                            kFound * Eigen::Vector2d(du, dv));
      if (!gross[static_cast<std::size_t>(v * kCorners + i)]) continue;
      const double way = random.uniform(0, 2 * std::numbers::pi), far = random.uniform(10, 40);
      view.pixels.back() += far * Eigen::Vector2d(std::cos(way), std::sin(way));
    }
    views.push_back(view);
  }
  const CameraCalibration found = calibrateCamera(views, camera.width, camera.height);
  return {lensOf(found.model) - x, Eigen::Map<const Lens>(found.half95.data()),
          sds(boundOf(x, X_CW)).head<kLensNumbers>()};
}

}  // namespace palpa::bench
