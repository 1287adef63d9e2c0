#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "anatomy/volume/volume.h"

/// Tools on masks and values that lie on one grid. Lengths are metres, along the grid's axes.
namespace palpa::anatomy {

using Mask = std::vector<std::uint8_t>;  ///< 0 or 1 a voxel
using Values = std::vector<float>;

struct VoxelGrid {
  Index3 size{0, 0, 0};
  Vec3 spacing = Vec3::Ones();

  std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  std::size_t index(const Index3& c) const {
    return (static_cast<std::size_t>(c[2]) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(c[1])) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(c[0]);
  }
  Index3 cell(std::size_t n) const {
    const auto nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
    return {static_cast<int>(n % nx), static_cast<int>(n / nx % ny), static_cast<int>(n / nx / ny)};
  }
  bool holds(const Index3& c) const {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < size[0] && c[1] < size[1] &&
           c[2] < size[2];
  }
  bool atBorder(const Index3& c) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (c[a] == 0 || c[a] == size[a] - 1) return true;
    return false;
  }
};

inline VoxelGrid gridOf(const Volume& volume) { return {volume.size, volume.spacing()}; }

/// Distance from each voxel's centre to the nearest voxel of the mask (0 in it; 1 m where there is
/// none), exact (Felzenszwalb and Huttenlocher 2012, one parabola envelope an axis).
Values distanceTo(const VoxelGrid& grid, const Mask& mask);

/// Signed distance to the mask's border, which runs half way between voxels: negative inside.
Values signedDistance(const VoxelGrid& grid, const Mask& mask);

Mask dilated(const VoxelGrid& grid, const Mask& mask, double radius);
Mask eroded(const VoxelGrid& grid, const Mask& mask,
            double radius);  ///< the grid's border counts as inside
inline Mask closed(const VoxelGrid& grid, const Mask& mask, double radius) {
  return eroded(grid, dilated(grid, mask, radius), radius);
}
inline Mask opened(const VoxelGrid& grid, const Mask& mask, double radius) {
  return dilated(grid, eroded(grid, mask, radius), radius);
}
Mask inverted(const Mask& mask);

/// Gaussian blur with a standard deviation in metres, cut at three of them; the border's values go
/// on outside.
Values blurred(const VoxelGrid& grid, Values values, double sigma);

/// Pieces joined by faces, numbered from 1 in order of their first voxel; 0 outside the mask.
struct VoxelPieces {
  std::vector<std::int32_t> label;
  std::vector<std::size_t> voxels;  ///< how many each has; [0] is nothing
};
VoxelPieces piecesOf(const VoxelGrid& grid, const Mask& mask);

/// The largest piece (the first of equals); all zero for an empty mask.
Mask largestPiece(const VoxelGrid& grid, const Mask& mask);

/// The mask with what it encloses; `by_slices`: what it encloses in any slice across any of the
/// three axes.
Mask filled(const VoxelGrid& grid, const Mask& mask, bool by_slices);

/// The mask with what it encloses in each slice across `axis`.
Mask filledAcross(const VoxelGrid& grid, const Mask& mask, std::size_t axis);

/// Markers (> 0) grow inside `within` up to `reach` metres of way, each voxel going to the marker
/// whose way to it is shortest: touching bones part half way between what is surely theirs.
std::vector<std::int32_t> grown(const VoxelGrid& grid, std::vector<std::int32_t> markers,
                                const Mask& within, double reach);

}  // namespace palpa::anatomy
