#pragma once

#include <string>
#include <vector>

#include "anatomy/import/mesh_file.h"

namespace palpa::anatomy {

/// What a repair has done.
struct RepairReport {
  std::size_t joined_points = 0;       ///< stored more than once, now once
  std::size_t dropped_triangles = 0;   ///< without an area, or twice
  std::size_t turned_triangles = 0;    ///< looked to the other side than their neighbours, or inward
  std::size_t closed_holes = 0, added_triangles = 0;
  std::size_t left_holes = 0;          ///< too large, or with a pinched edge

  bool changed() const { return joined_points + dropped_triangles + turned_triangles + closed_holes > 0; }
};

/// Holes with more edges than this are an opening that somebody meant, not a flaw.
inline constexpr std::size_t kLargestHole = 200;

/// The surface with every place stored once, without triangles that are nothing, all of a piece looking to one side,
/// holes of up to kLargestHole edges closed by a fan about their middle, closed pieces looking outward. Points keep
/// their places; nothing is smoothed. A surface that is sound comes back as it was, but for the order of its points.
RawMesh repaired(const RawMesh& mesh, RepairReport* report);

/// What was done, in plain words.
std::vector<std::string> words(const RepairReport& report);

}  // namespace palpa::anatomy
