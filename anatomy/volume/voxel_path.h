#pragma once

#include "anatomy/volume/scan.h"

namespace palpa::anatomy {

/// The way from voxel to voxel (26 neighbours) whose sum of length times `cost` is least (Dijkstra
/// 1959); cost > 0, in [1/m] of no meaning, infinite where no way may lead. Empty when there is
/// none.
std::vector<std::size_t> cheapestPath(const VoxelGrid& grid, const Values& cost, std::size_t from,
                                      std::size_t to);

/// Points of a path in S, rounded by a running mean over `reach` metres to either side, about 2 mm
/// apart; ends stay.
std::vector<Vec3> smoothLine(const std::vector<Vec3>& points, double reach);

/// Line through the middle of a long piece, from end to end: between the two voxels whose way
/// inside it is longest, by the way that keeps off its border. Needs a non-empty mask of one piece.
std::vector<Vec3> centreLine(const Scan& scan, const Mask& mask);

}  // namespace palpa::anatomy
