#pragma once

#include <optional>
#include <string>

#include "anatomy/geometry/pose.h"

/// What 3D Slicer and PLUS expect, in this one place. A transform `XToY` is the pose of X in Y
/// (X_YX): it takes coordinates in X to coordinates in Y. Translations are millimetres. Frames that
/// are no anatomy keep their axes; anatomy is RAS there (x right, y anterior, z superior) and LPS
/// here (frame A: x left, y posterior, z superior), so x and y change their sign.
namespace palpa::igt {

inline constexpr const char* kReference = "Reference";  ///< W: the board on the table
/// anatomy, in RAS; "Ras" where a scene is meant that is RAS as a whole
inline constexpr const char* kPatient = "Patient";
inline constexpr const char* kRas = "Ras";

/// "NeedleTipToReference". A name on the wire holds at most 20 characters.
std::string toName(const std::string& from, const std::string& to);

/// A rigid pose as a homogeneous matrix in millimetres.
Mat4 toWire(const Pose& X);

/// And back to metres. Nothing unless it is finite, a proper rotation within `kRotationError` (no
/// scale, no mirror: what is within is made orthonormal), less than 100 m away.
inline constexpr double kRotationError = 1e-3;
std::optional<Pose> fromWire(const Mat4& X_mm);

/// X_AR, the pose of anatomy's RAS frame in A: same origin, x and y the other way.
Pose rasInAnatomy();

/// "OK" and whatever else PLUS says of a transform: only OK may be used.
bool mayBeUsed(const std::string& transform_status);

}  // namespace palpa::igt
