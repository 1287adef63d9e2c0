#pragma once

#include "anatomy/geometry/local_geometry.h"

namespace palpa::haptics {

/// Nothing that a desktop device can touch is farther from its base, m.
inline constexpr double kFarthest = 10;

/// Whether a snapshot can be what its maker meant: numbered, counts within their arrays, every
/// number finite and no farther than kFarthest, normals of unit length, organs and tissues that
/// exist. Only the entries that are in use are looked at. Costs about as much as copying the
/// snapshot.
bool plausible(const LocalGeometry& geometry) noexcept;

}  // namespace palpa::haptics
