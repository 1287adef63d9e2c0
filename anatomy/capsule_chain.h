#pragma once

#include <vector>

#include "anatomy/geometry/local_geometry.h"
#include "anatomy/surface_query.h"

namespace palpa::anatomy {

/// A long bone near its point `nearest` as up to three capsules end to end, 16 mm each: the middle one touches the
/// mesh at `nearest` with its normal, the others follow the bend to either side (a clavicle bends with radii down to
/// 34 mm: a single capsule of 48 mm would miss it by 8 mm at its ends). Where the bone ends the chain ends; what is
/// no longer than thick becomes a sphere or nearly one. Empty for a plate, which no capsule fits. Frame A, metres;
/// `organ` and `bone` are the caller's.
/// `links`: 3, or 1 for the middle one alone.
std::vector<Capsule> capsuleChain(const SurfaceQuery& query, int surface, const SurfacePoint& nearest, int links = 3);

}  // namespace palpa::anatomy
