#include "apps/link/igtl/conventions.h"

#include "anatomy/base/units.h"
#include "anatomy/geometry/dense_solvers.h"

namespace palpa::igt {
namespace {

constexpr double kFarthest_mm = 1e5;

}  // namespace

std::string toName(const std::string& from, const std::string& to) { return from + "To" + to; }

Mat4 toWire(const Pose& X) {
  Mat4 X_mm = X.matrix();
  X_mm.topRightCorner<3, 1>() /= kMm;
  return X_mm;
}

std::optional<Pose> fromWire(const Mat4& X_mm) {
  if (!X_mm.allFinite() ||
      (X_mm.row(3) - Mat4::Identity().row(3)).cwiseAbs().maxCoeff() > kRotationError)
    return std::nullopt;
  const Mat3 R = X_mm.topLeftCorner<3, 3>();
  if ((R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff() > kRotationError ||
      R.determinant() < 0)
    return std::nullopt;
  const Vec3 p_mm = X_mm.topRightCorner<3, 1>();
  if (p_mm.cwiseAbs().maxCoeff() > kFarthest_mm) return std::nullopt;
  const SingularValues<3> svd = singularValues(R);
  return makePose(svd.U * svd.V.transpose(), kMm * p_mm);
}

Pose rasInAnatomy() { return makePose(Vec3(-1, -1, 1).asDiagonal().toDenseMatrix(), Vec3::Zero()); }

bool mayBeUsed(const std::string& transform_status) { return transform_status == "OK"; }

}  // namespace palpa::igt
