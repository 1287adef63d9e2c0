#pragma once

#include <Eigen/Geometry>
#include <array>

/// Poses and points in monogram notation: `X_AB` is the pose of frame B in A, `p_AB` the position
/// of B's origin in A, `v_A` a vector expressed in A; `X_AC = X_AB * X_BC`. Metres and radians.
namespace palpa {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;
using Quat = Eigen::Quaterniond;
using Pose = Eigen::Isometry3d;

/// Trivially copyable forms, for what crosses threads and enters records. Eigen's are not.
using Packed3 = std::array<double, 3>;
using Packed4 = std::array<double, 4>;  ///< quaternion, w x y z

struct PackedPose {
  Packed3 p{0, 0, 0};
  Packed4 q{1, 0, 0, 0};
};

inline Packed3 pack(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Packed4 pack(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline PackedPose pack(const Pose& X) {
  return {pack(Vec3(X.translation())), pack(Quat(X.rotation()))};
}

inline Vec3 unpack(const Packed3& v) { return {v[0], v[1], v[2]}; }
inline Quat unpack(const Packed4& q) { return {q[0], q[1], q[2], q[3]}; }
inline Pose unpack(const PackedPose& X) {
  Pose result = Pose::Identity();
  result.linear() = unpack(X.q).toRotationMatrix();
  result.translation() = unpack(X.p);
  return result;
}

inline Pose makePose(const Mat3& R, const Vec3& p) {
  Pose X = Pose::Identity();
  X.linear() = R;
  X.translation() = p;
  return X;
}

/// The smallest turn that takes the direction of `from` to that of `to`; about any axis across them
/// where they are opposite. Not inline: Eigen's way to it holds a singular value decomposition,
/// which would cost every source that includes this file six seconds to compile.
Quat turnBetween(const Vec3& from, const Vec3& to);

/// Any rotation that takes +z to the unit vector `z`.
Mat3 rotationWithZ(const Vec3& z);
/// The same with its y as near to `y_toward` as that lets it be; where the two are parallel, as
/// above.
Mat3 rotationWithZ(const Vec3& z, const Vec3& y_toward);

}  // namespace palpa
