#include "anatomy/query/surface_curvature.h"

#include <Eigen/Cholesky>
#include <array>

#include "anatomy/base/pinned_math.h"

namespace palpa::anatomy {
namespace {

/// Of one triangle, in A; zero where it has no area.
ShapeOperator ofTriangle(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n,
                         const Vec3& twice_area) {
  const Vec3 face = twice_area.normalized(), x = (p[1] - p[0]).normalized(), y = face.cross(x);
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = p[(k + 1) % 3] - p[k], turn = n[(k + 1) % 3] - n[k];
    const double u = edge.dot(x), v = edge.dot(y), du = turn.dot(x), dv = turn.dot(y);
    // (e f; f g) (u v)^T = (du dv)^T in the unknowns e, f, g.
    A += (Mat3() << u * u, u * v, 0, u * v, u * u + v * v, u * v, 0, u * v, v * v).finished();
    b += Vec3(u * du, v * du + u * dv, v * dv);
  }
  const Vec3 efg = A.ldlt().solve(b);
  if (!efg.allFinite()) return ShapeOperator::Zero();
  return efg[0] * x * x.transpose() + efg[1] * (x * y.transpose() + y * x.transpose()) +
         efg[2] * y * y.transpose();
}

/// Carried from the face's plane into the one across n: the axis of the fold stays, the rest is
/// turned.
ShapeOperator intoPlane(const ShapeOperator& S, const Vec3& face, const Vec3& n) {
  const Quat turn = turnBetween(face, n);
  const Mat3 R = turn.toRotationMatrix();
  return R * S * R.transpose();
}

}  // namespace

std::vector<ShapeOperator> vertexShapeOperators(const TriangleMesh& mesh) {
  std::vector<ShapeOperator> shape(mesh.points.size(), ShapeOperator::Zero());
  std::vector<double> weight(mesh.points.size(), 0);
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3, 3> p{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    const std::array<Vec3, 3> n{mesh.normals[t[0]], mesh.normals[t[1]], mesh.normals[t[2]]};
    const Vec3 twice_area = (p[1] - p[0]).cross(p[2] - p[0]);
    const double area = twice_area.norm();
    if (!(area > 0)) continue;
    const ShapeOperator S = ofTriangle(p, n, twice_area);
    for (int k = 0; k < 3; ++k) {
      shape[t[k]] += area * intoPlane(S, twice_area / area, n[k]);
      weight[t[k]] += area;
    }
  }
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (weight[i] > 0) shape[i] /= weight[i];
  return shape;
}

PrincipalCurvatures principalCurvatures(const ShapeOperator& S, const Vec3& n) {
  const Vec3 x = n.unitOrthogonal(), y = n.cross(x);
  const double e = x.dot(S * x), f = x.dot(S * y), g = y.dot(S * y);
  const double mean = (e + g) / 2, half = (e - g) / 2, spread = pinned::hypot(half, f);
  const double angle = spread > 0 ? pinned::atan2(f, half) / 2 : 0;
  PrincipalCurvatures k;
  k.k1 = mean + spread;
  k.k2 = mean - spread;
  k.d1 = pinned::cos(angle) * x + pinned::sin(angle) * y;
  k.d2 = n.cross(k.d1);
  return k;
}

}  // namespace palpa::anatomy
