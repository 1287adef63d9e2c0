#include "apps/bench/bench_patients.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/parametric/parametric_patient.h"
#include "apps/station/assets.h"

namespace palpa::bench {
namespace {

constexpr double kHalfWide = 0.110, kHalfLong = 0.085, kRx = 0.18, kRy = 0.9;
constexpr double kAmplitude = 0.001, kWave = 2 * std::numbers::pi / 0.040;

struct Slopes {
  double z, zx, zy, zxx, zxy, zyy;
};

Slopes slopes(double x, double y) {
  const double cx = std::cos(kWave * x), sx = std::sin(kWave * x), cy = std::cos(kWave * y),
               sy = std::sin(kWave * y), A = kAmplitude, k = kWave;
  return {-x * x / (2 * kRx) - y * y / (2 * kRy) + A * cx * cy,
          -x / kRx - A * k * sx * cy,
          -y / kRy - A * k * cx * sy,
          -1 / kRx - A * k * k * cx * cy,
          A * k * k * sx * sy,
          -1 / kRy - A * k * k * cx * cy};
}

}  // namespace

TorsoPoint torsoAt(double x, double y) {
  const Slopes s = slopes(x, y);
  return {{x, y, s.z}, Vec3(-s.zx, -s.zy, 1).normalized()};
}

TorsoPoint nearestOnTorso(const Vec3& p) {
  Eigen::Vector2d u = p.head<2>();
  for (int i = 0; i < 30; ++i) {
    const Slopes s = slopes(u.x(), u.y());
    const double gap = s.z - p.z();
    const Eigen::Vector2d g(u.x() - p.x() + gap * s.zx, u.y() - p.y() + gap * s.zy);
    Eigen::Matrix2d H;
    H << 1 + s.zx * s.zx + gap * s.zxx, s.zx * s.zy + gap * s.zxy, s.zx * s.zy + gap * s.zxy,
        1 + s.zy * s.zy + gap * s.zyy;
    const Eigen::Vector2d step = H.inverse() * g;
    u -= step;
    if (step.norm() < 1e-12) break;
  }
  return torsoAt(u.x(), u.y());
}

anatomy::Patient torsoPatient(int triangles) {
  const int columns =
      std::max(2, int(std::lround(std::sqrt(triangles / 2.0 * kHalfWide / kHalfLong))));
  const int rows = std::max(2, int(std::lround(triangles / 2.0 / columns)));
  anatomy::TriangleMesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const TorsoPoint q =
          torsoAt(kHalfWide * (2.0 * i / columns - 1), kHalfLong * (2.0 * j / rows - 1));
      mesh.points.push_back(q.p);
      mesh.normals.push_back(q.n);
    }
  const auto at = [&](int i, int j) { return std::uint32_t(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  anatomy::Patient patient;
  patient.name = "bumpy torso";
  patient.organs.push_back({"skin", Organ::skin, std::move(mesh), {1, 1, 1, 1}});
  return patient;
}

anatomy::Patient referenceBust() {
  anatomy::PatientParameters parameters = anatomy::drawParameters(
      anatomy::readPopulation(station::assetFile("patients/reference.json").string()),
      anatomy::Side::right, 0);
  parameters.extent = anatomy::Extent::bust;
  return anatomy::buildPatient(parameters);
}

Pose lookAt(const Vec3& eye_A, const Vec3& target_A) {
  const Vec3 z = (target_A - eye_A).normalized(), x = z.cross(Vec3::UnitZ()).normalized();
  Mat3 R_AC;
  R_AC << x, z.cross(x), z;
  return makePose(R_AC, eye_A).inverse();
}

}  // namespace palpa::bench
