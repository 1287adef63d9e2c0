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
  Mask body;    ///< without table and clothes, holes filled; clipped: the closed envelope of soft
                ///< tissue
  Mask tissue;  ///< what of it is seen as soft tissue or brighter
  double midline_x = 0;  ///< of S: mean of the bone

  Vec3 place(const Index3& c) const { return volume.pointToS(Vec3(c[0], c[1], c[2])); }
  Vec3 place(std::size_t n) const { return place(grid.cell(n)); }
  Index3 cellAt(const Vec3& p_S) const;  ///< nearest voxel, inside the volume
  Mask above(double level) const;        ///< of the body
};
Scan prepareScan(const Volume& volume, const Levels& levels);

}  // namespace palpa::anatomy
