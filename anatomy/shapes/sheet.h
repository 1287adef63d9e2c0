#pragma once

#include <functional>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// A point of a sheet's middle surface, its unit normal, and how far the sheet reaches to either
/// side; both halves 0 on the border.
struct SheetPoint {
  Vec3 middle, normal;
  double front, back;
};

/// Closed mesh of a sheet over the unit square, `along` x `across` quads a side.
TriangleMesh sheet(const std::function<SheetPoint(double u, double v)>& at, int along, int across);

}  // namespace palpa::anatomy
