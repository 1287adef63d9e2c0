#pragma once

#include <functional>
#include <map>
#include <string>

#include "anatomy/volume/voxel_grid.h"

namespace palpa::anatomy {

/// Told before each step that takes a while; `done` from 0 to 1.
using StepProgress = std::function<void(const std::string& step, double done)>;

/// Places in the volume's frame S by name, metres: what the automatic search proposes and a person
/// may move.
using Seeds = std::map<std::string, Vec3>;

/// Values that part tissues. In Hounsfield units when the volume holds air; a volume clipped to a
/// window that lost air, lung and fat (all at its least value) is told by that, and gets fractions
/// of its range.
struct Levels {
  bool clipped = false;
  double soft = -300;  ///< body against air; clipped: soft tissue against all that was lost
  double bone = 200;   ///< cancellous bone and arteries in contrast begin
  double dense = 450;  ///< undiluted contrast and the hardest cortex
};
Levels levelsOf(const Volume& volume);

/// The part of a volume that is worked on: along the body, reduced to voxels of about 1.4 mm, from
/// 120 mm above the shoulders to 200 mm below.
struct Scan {
  Volume volume;
  VoxelGrid grid;
  Levels levels;
  /// Without table and clothes, holes filled; clipped: the closed envelope of soft tissue
  Mask body;
  Mask tissue;           ///< what of it is seen as soft tissue or brighter
  double midline_x = 0;  ///< of S: mean of the bone

  Vec3 place(const Index3& c) const { return volume.pointToS(Vec3(c[0], c[1], c[2])); }
  Vec3 place(std::size_t n) const { return place(grid.cell(n)); }
  Index3 cellAt(const Vec3& p_S) const;  ///< nearest voxel, inside the volume
  Mask above(double level) const;        ///< of the body
};
Scan prepareScan(const Volume& volume, const Levels& levels);

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

/// A sentence with the option to give when the volume seems to lie otherwise than its header says;
/// empty otherwise. Looked at: the bone near the midline (spine) lies behind the body's middle;
/// beside it there is more bone at the shoulders' end than at the other. Either must be clear (3
/// mm; a factor of 1.6) to be said.
std::string probableFlip(const Volume& volume, const Levels& levels);

}  // namespace palpa::anatomy
