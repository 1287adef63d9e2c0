#include "anatomy/volume/segmentation.h"

#include <algorithm>
#include <cmath>

namespace palpa::anatomy {
namespace {

constexpr double kMediastinum = 40e-3;  // lungs closed by this hold heart and great vessels
constexpr double kIndent = 9e-3;        // ribs press no deeper into the closed lungs
constexpr double kUnderSkin = 20e-3, kFrontRib = 28e-3,
                 kBackRib = 60e-3;                          // depth of sternum and ribs
constexpr double kWall = 14e-3;                             // ribs lie within this of the lung
constexpr double kSternumStrip = 12e-3, kRibsFrom = 38e-3;  // half widths from the midline
constexpr double kPlate = 5e-3;                             // marrow and gaps between its parts
constexpr double kSpine = 40e-3;
constexpr double kPool = 6.5e-3,
                 kPoolRim = 5e-3;  // a ball so large fits into heart and spine, into no rib

Mask unionOf(const std::vector<LabelledOrgan>& organs, std::size_t count) {
  Mask all(count, 0);
  for (const LabelledOrgan& organ : organs)
    for (std::size_t n = 0; n < count; ++n) all[n] |= organ.mask[n];
  return all;
}

/// Heart, aorta and whatever else is bright and thicker than a rib.
Mask pools(const Scan& scan, const Mask& bright) {
  return dilated(scan.grid, eroded(scan.grid, bright, kPool), kPool + kPoolRim);
}

/// Bone of the chest's wall: near the lungs, not inside of what they enclose, not the spine.
Mask wallBone(const Scan& scan, const Mask& lungs, const Mask& taken, double midline_x,
              double front_y, double top_z) {
  const Values to_lung = distanceTo(scan.grid, lungs);
  const Values inside = distanceTo(scan.grid, inverted(closed(scan.grid, lungs, kMediastinum)));
  const Values under = distanceTo(scan.grid, inverted(scan.body));
  Mask bone = scan.above(scan.levels.bone);
  const Mask pool = pools(scan, bone);
  for (std::size_t n = 0; n < bone.size(); ++n) {
    if (!bone[n]) continue;
    const Vec3 p = scan.place(n);
    const double off = std::abs(p.x() - midline_x);
    const bool spine = off < kSpine && p.y() > front_y + 0.07;
    const bool at_front =
        off < kRibsFrom && p.y() < front_y + 0.025 && p.z() < top_z + 0.01 && under[n] < kUnderSkin;
    const double deepest = p.y() < front_y + 0.06 ? kFrontRib : kBackRib;
    bone[n] = !taken[n] && !spine &&
              (at_front || (off > kRibsFrom && !pool[n] && to_lung[n] <= kWall &&
                            inside[n] <= kIndent && under[n] <= deepest));
  }
  return bone;
}

Mask partOf(const std::vector<std::int32_t>& labels, std::int32_t label) {
  Mask mask(labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n) mask[n] = labels[n] == label;
  return mask;
}

}  // namespace

std::vector<LabelledOrgan> findThoraxBones(const Scan& scan,
                                           const std::vector<LabelledOrgan>& lungs,
                                           const Mask& taken, double midline_x, double front_y,
                                           double top_z) {
  std::vector<LabelledOrgan> organs;
  if (lungs.empty()) return organs;
  const Mask bone = wallBone(scan, unionOf(lungs, taken.size()), taken, midline_x, front_y, top_z);
  std::vector<std::int32_t> markers(bone.size(), 0);
  for (std::size_t n = 0; n < bone.size(); ++n) {
    if (!bone[n]) continue;
    const Vec3 p = scan.place(n);
    const double off = std::abs(p.x() - midline_x);
    if (off < kSternumStrip && p.y() < front_y + 0.03) markers[n] = 1;
    if (off > kRibsFrom) markers[n] = 2;
  }
  const std::vector<std::int32_t> parted = grown(scan.grid, std::move(markers), bone, 0.05);
  const Mask plate = filled(scan.grid, closed(scan.grid, partOf(parted, 1), kPlate), true);
  Mask sternum = largestPiece(scan.grid, opened(scan.grid, plate, kPlate / 2));
  Mask ribs = filled(scan.grid, closed(scan.grid, partOf(parted, 2), 2e-3), true);
  for (std::size_t n = 0; n < ribs.size(); ++n)
    sternum[n] = sternum[n] && !taken[n], ribs[n] = ribs[n] && !sternum[n] && !taken[n];
  organs.push_back({"sternum", Organ::sternum, std::move(sternum), false, 2.0e-3, 2.0e-3});
  addRibs(scan, ribs, lungs, midline_x, &organs);
  return organs;
}

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
  VoxelPieces pieces = piecesOf(scan.grid, core);
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
