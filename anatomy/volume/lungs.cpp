#include <algorithm>
#include <cmath>

#include "anatomy/volume/thorax_bones.h"

namespace palpa::anatomy {
namespace {

constexpr double kAirInLung = -500;    // HU
constexpr double kCavity = 10e-3;      // fat between muscles is narrower than twice this
constexpr double kLeastLung = 100e-6;  // m^3
constexpr double kVessels = 8e-3;      // lung closes over its vessels
constexpr double kMidline = 6e-3;      // half of what at least parts estimated lungs
constexpr double kColumn = 50e-3,
                 kColumnFat = 18e-3;  // half width of the mediastinum; fat in it closes

/// Heart, vessels, spine and the fat between them: fat looks as lungs do where it is clipped.
Mask mediastinum(const Scan& scan, double midline_x) {
  Mask column(scan.body.size());
  for (std::size_t n = 0; n < column.size(); ++n)
    column[n] = scan.tissue[n] && std::abs(scan.place(n).x() - midline_x) < kColumn;
  column = closed(scan.grid, opened(scan.grid, column, kVessels / 2), kColumnFat);
  for (std::size_t n = 0; n < column.size(); ++n)
    column[n] |= std::abs(scan.place(n).x() - midline_x) <= kMidline;
  return column;
}

}  // namespace

std::vector<LabelledOrgan> findLungs(const Scan& scan, double midline_x) {
  const bool clipped = scan.levels.clipped;
  const Mask between = clipped ? mediastinum(scan, midline_x) : Mask(scan.body.size(), 0);
  Mask air(scan.body.size());
  for (std::size_t n = 0; n < air.size(); ++n)
    air[n] = scan.body[n] &&
             (clipped ? !scan.tissue[n] && !between[n] : scan.volume.values[n] <= kAirInLung);
  const double opening = clipped ? kCavity : 2e-3;
  const Mask core = opened(scan.grid, air, opening);
  Pieces pieces = piecesOf(scan.grid, core);
  std::vector<std::int32_t> largest;
  for (int i = 0; i < 2; ++i) {
    pieces.voxels[0] = 0;
    const auto most = std::max_element(pieces.voxels.begin(), pieces.voxels.end());
    if (static_cast<double>(*most) * scan.grid.spacing.prod() < kLeastLung) break;
    largest.push_back(static_cast<std::int32_t>(most - pieces.voxels.begin()));
    *most = 0;
  }
  std::vector<LabelledOrgan> lungs;
  for (const std::int32_t piece : largest) {
    Mask core_of(pieces.label.size());
    for (std::size_t n = 0; n < core_of.size(); ++n) core_of[n] = pieces.label[n] == piece;
    LabelledOrgan lung{
        "",      Organ::lung, filled(scan.grid, closed(scan.grid, core_of, kVessels), true),
        clipped, 3e-3,        2.8e-3};
    for (std::size_t n = 0; n < lung.mask.size(); ++n) lung.mask[n] = lung.mask[n] && !between[n];
    double x = 0, count = 0;
    for (std::size_t n = 0; n < lung.mask.size(); ++n)
      if (lung.mask[n]) x += scan.place(n).x(), ++count;
    lung.id = std::string(x / std::max(count, 1.0) < midline_x ? "lung_right" : "lung_left") +
              (clipped ? "_estimated" : "");
    if (!lungs.empty() && lungs.front().id == lung.id) break;
    lungs.push_back(std::move(lung));
  }
  return lungs;
}

}  // namespace palpa::anatomy
