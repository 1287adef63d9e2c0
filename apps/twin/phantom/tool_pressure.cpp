#include "apps/twin/phantom/tool_pressure.h"

#include <Eigen/Geometry>
#include <cmath>

namespace palpa::twin {
namespace {

constexpr int kPoints = 4;  // Gauss points each way: the edge of contact runs through faces
constexpr double kAt[kPoints] = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                 0.861136311594053};
constexpr double kWeight[kPoints] = {0.347854845137454, 0.652145154862546, 0.652145154862546,
                                     0.347854845137454};
constexpr int kFaceCorner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

}  // namespace

FacePressure pressureOn(const std::array<Vec3, 4>& before, const std::array<Vec3, 4>& now,
                        const RoundTip& tip, double stiffness) {
  FacePressure face;
  for (int gu = 0; gu < kPoints; ++gu) {
    for (int gv = 0; gv < kPoints; ++gv) {
      Eigen::Vector4d N;
      Vec3 x = Vec3::Zero(), along_u = Vec3::Zero(), along_v = Vec3::Zero();
      for (int a = 0; a < 4; ++a) {
        const double u = 1 + kFaceCorner[a][0] * kAt[gu], v = 1 + kFaceCorner[a][1] * kAt[gv];
        N[a] = u * v / 4;
        x += N[a] * now[a];
        along_u += kFaceCorner[a][0] * v / 4 * before[a];
        along_v += kFaceCorner[a][1] * u / 4 * before[a];
      }
      const Vec3 away = x - tip.centre;
      const double distance = away.norm(), g = distance - tip.radius;
      if (g >= 0) continue;
      face.touches = true;
      const double e = stiffness * kWeight[gu] * kWeight[gv] * along_u.cross(along_v).norm();
      const Vec3 n = away / distance;
      face.E += 0.5 * e * g * g;
      face.f_tip += e * g * n;
      const Mat3 T =
          e * n *
          n.transpose();  // without the turn of n, which is small and would make it indefinite
      for (int a = 0; a < 4; ++a) {
        face.gradient.segment<3>(3 * a) += N[a] * e * g * n;
        for (int b = 0; b < 4; ++b) face.tangent.block<3, 3>(3 * a, 3 * b) += N[a] * N[b] * T;
      }
    }
  }
  return face;
}

}  // namespace palpa::twin
