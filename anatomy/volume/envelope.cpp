#include "anatomy/volume/envelope.h"

namespace palpa::anatomy {
namespace {

constexpr double kFurrow = 7e-3;  // narrower than twice this between muscles is fat under one skin

}  // namespace

Mask skinMask(const Scan& scan, const std::vector<LabelledOrgan>& parts) {
  if (!scan.levels.clipped) return scan.body;
  Mask inside = scan.tissue;
  for (const LabelledOrgan& part : parts)
    for (std::size_t n = 0; n < inside.size(); ++n) inside[n] |= part.mask[n];
  inside =
      filledAcross(scan.grid, closed(scan.grid, filledAcross(scan.grid, inside, 2), kFurrow), 2);
  return largestPiece(scan.grid, inside);
}

}  // namespace palpa::anatomy
