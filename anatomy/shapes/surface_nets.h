#pragma once

#include "anatomy/patient.h"
#include "anatomy/shapes/field.h"

namespace palpa::anatomy {

/// Closed mesh of a field's zero surface inside `box`, which must hold it with a cell to spare
/// (Gibson 1998: one vertex in every cell that the surface cuts, one quad across every cut edge).
/// Vertices are then moved onto the surface by Newton steps; normals are the field's gradient.
/// The field may grow at most `slope` times as fast as distance: far cells are skipped by that.
TriangleMesh surfaceNets(const Field& field, const Eigen::AlignedBox3d& box, double cell,
                         double slope = 2);

}  // namespace palpa::anatomy
