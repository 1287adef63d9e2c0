#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "anatomy/base/units.h"
#include "anatomy/geometry/pose.h"

namespace palpa::calibration {

inline Mat3 crossMatrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Rotation by |w| about w.
Mat3 rotationOf(const Vec3& w);

/// What points up points down after it, x stays: a needle upright, a board that faces a camera.
inline Mat3 halfTurnAboutX() { return Vec3(1, -1, -1).asDiagonal(); }

/// w of a rotation; |w| is 0 to pi.
Vec3 rotationVector(const Mat3& R);

/// The pose moved by dx: turned by the first three in its own frame, shifted by the last three in
/// the outer one.
template <class Vector6>
Pose moved(const Pose& X, const Vector6& dx) {
  return makePose(X.rotation() * rotationOf(Vec3(dx[0], dx[1], dx[2])),
                  X.translation() + Vec3(dx[3], dx[4], dx[5]));
}

/// Covariance of X p by that of X (turn in its own frame, shift in the outer one): J = [-R [p]x,
/// I].
Mat3 pointCovariance(const Pose& X, const Eigen::Matrix<double, 6, 6>& covariance, const Vec3& p);

/// Covariance of the inverse pose: turn' = -R turn, shift' = [X^-1 0]x turn - R' shift.
Eigen::Matrix<double, 6, 6> inverseCovariance(const Pose& X,
                                              const Eigen::Matrix<double, 6, 6>& covariance);

/// How far each direction of the rotations' inner frame was tilted: the mean of |(R_i - mean R)
/// u|^2 is 1 - |mean R u|^2, which for a tilt by a about an axis across u is a^2. The direction
/// that kept best where it was, and its rms tilt, rad; `most`: that of the direction that was
/// tilted most.
struct LeastTilted {
  Vec3 axis;
  double spread, most;
};
LeastTilted leastTilted(const std::vector<Pose>& poses);

/// Throws Error for a pose that is not a number, or whose rotation is none.
void requirePose(const Pose& X, const std::string& where);

/// The rotation nearest to m (least squares of the entries), never a mirror.
Mat3 nearestRotation(const Mat3& m);

}  // namespace palpa::calibration
