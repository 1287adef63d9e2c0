#pragma once

#include <string>
#include <vector>

#include "anatomy/import/mesh_file.h"

namespace palpa::anatomy {

/// What a repair has done.
struct RepairReport {
  std::size_t joined_points = 0;      ///< stored more than once, now once
  std::size_t welded_points = 0;      ///< of seams, near but not the same (weld.h)
  double farthest_weld = 0;           ///< by which the weld has moved a point, in the file's unit
  std::size_t dropped_triangles = 0;  ///< without an area, or twice
  std::size_t scraps = 0;  ///< triangles of parts that are too small to enclose anything, dropped
  std::size_t turned_triangles = 0;  ///< looked to the other side than their neighbours, or inward
  std::size_t closed_holes = 0, added_triangles = 0;
  std::size_t left_holes = 0;  ///< too large, or without a ring round them

  bool changed() const {
    return joined_points + welded_points + dropped_triangles + scraps + turned_triangles +
               closed_holes >
           0;
  }
};

/// Holes with more edges than this are an opening that somebody meant, not a flaw.
inline constexpr std::size_t kLargestHole = 200;

/// Seams wider than this are not welded unless somebody asks for it, m.
inline constexpr double kWeldTolerance = 2e-5;

/// The surface with every place stored once, without triangles that are nothing or hang loose, all
/// of a piece looking to one side, seams up to `tolerance` (file's unit; 0: none) welded, holes of
/// up to kLargestHole edges closed by the triangles of least area between their own points, closed
/// pieces looking outward. But for the weld, points keep their places; nothing is smoothed. A
/// surface that is sound comes back as it was, but for the order of its points.
RawMesh repaired(const RawMesh& mesh, RepairReport* report, double tolerance = 0);

/// What was done, in plain words; `metres`: the file's unit.
std::vector<std::string> words(const RepairReport& report, double metres = 1);

}  // namespace palpa::anatomy
