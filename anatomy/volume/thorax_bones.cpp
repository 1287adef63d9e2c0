#include "anatomy/volume/thorax_bones.h"

#include <algorithm>
#include <cmath>

namespace palpa::anatomy {
namespace {

constexpr double kAirInLung = -500;                        // HU
constexpr double kCavity = 10e-3;                          // fat between muscles is narrower than twice this
constexpr double kLeastLung = 100e-6;                      // m^3
constexpr double kMediastinum = 40e-3;                     // lungs closed by this hold heart and great vessels
constexpr double kMidline = 6e-3;                          // half of what parts estimated lungs
constexpr double kIndent = 9e-3;                           // ribs press no deeper into the closed lungs
constexpr double kUnderSkin = 20e-3, kFrontRib = 28e-3, kBackRib = 60e-3;  // depth of sternum and ribs
constexpr double kWall = 14e-3;                            // ribs lie within this of the lung
constexpr double kSternumStrip = 12e-3, kRibsFrom = 38e-3; // half widths from the midline
constexpr double kSpine = 40e-3;
constexpr double kLeastRib = 1.5e-6;                       // m^3

Mask unionOf(const std::vector<LabelledOrgan>& organs, std::size_t count) {
  Mask all(count, 0);
  for (const LabelledOrgan& organ : organs)
    for (std::size_t n = 0; n < count; ++n) all[n] |= organ.mask[n];
  return all;
}

/// Bone of the chest's wall: near the lungs, not inside of what they enclose, not the spine.
Mask wallBone(const Scan& scan, const Mask& lungs, const Mask& taken, double midline_x, double front_y, double top_z) {
  const Values to_lung = distanceTo(scan.grid, lungs);
  const Values inside = distanceTo(scan.grid, inverted(closed(scan.grid, lungs, kMediastinum)));
  const Values under = distanceTo(scan.grid, inverted(scan.body));
  Mask bone = scan.above(scan.levels.bone);
  for (std::size_t n = 0; n < bone.size(); ++n) {
    if (!bone[n]) continue;
    const Vec3 p = scan.place(n);
    const double off = std::abs(p.x() - midline_x);
    const bool spine = off < kSpine && p.y() > front_y + 0.07;
    const bool at_front = off < kRibsFrom && p.y() < front_y + 0.025 && p.z() < top_z + 0.01 && under[n] < kUnderSkin;
    const double deepest = p.y() < front_y + 0.06 ? kFrontRib : kBackRib;
    bone[n] = !taken[n] && !spine && (at_front || (off > kRibsFrom && to_lung[n] <= kWall && inside[n] <= kIndent && under[n] <= deepest));
  }
  return bone;
}

Mask partOf(const std::vector<std::int32_t>& labels, std::int32_t label) {
  Mask mask(labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n) mask[n] = labels[n] == label;
  return mask;
}

std::string sideOf(double x, double midline_x) { return x < midline_x ? "right" : "left"; }

/// What is left is ribs: pieces from above downward, numbered on each side.
void addRibs(const Scan& scan, const Mask& ribs, double midline_x, std::vector<LabelledOrgan>* organs) {
  const Pieces pieces = piecesOf(scan.grid, ribs);
  struct Piece { std::int32_t label; double x, z; };
  std::vector<Vec3> sum(pieces.voxels.size(), Vec3::Zero());
  for (std::size_t n = 0; n < ribs.size(); ++n)
    if (pieces.label[n]) sum[static_cast<std::size_t>(pieces.label[n])] += scan.place(n);
  std::vector<Piece> found;
  for (std::size_t i = 1; i < sum.size(); ++i) {
    const double count = static_cast<double>(pieces.voxels[i]);
    if (count * scan.grid.spacing.prod() >= kLeastRib) found.push_back({static_cast<std::int32_t>(i), sum[i].x() / count, sum[i].z() / count});
  }
  std::stable_sort(found.begin(), found.end(), [](const Piece& a, const Piece& b) { return a.z > b.z; });
  int number[2] = {0, 0};
  for (const Piece& piece : found) {
    const std::string side = sideOf(piece.x, midline_x);
    const int count = ++number[side == "left"];
    organs->push_back({"rib_piece_" + std::to_string(count) + "_" + side, Organ::rib, partOf(pieces.label, piece.label), false, 1.0e-3, 2.5e-3});
  }
}

}  // namespace

std::vector<LabelledOrgan> findLungs(const Scan& scan, double midline_x) {
  Mask air(scan.body.size());
  const double level = scan.levels.clipped ? scan.levels.soft : kAirInLung;
  for (std::size_t n = 0; n < air.size(); ++n) air[n] = scan.body[n] && scan.volume.values[n] <= level;
  for (std::size_t n = 0; scan.levels.clipped && n < air.size(); ++n)  // fat between them looks as they do
    air[n] = air[n] && std::abs(scan.place(n).x() - midline_x) > kMidline;
  const double opening = scan.levels.clipped ? kCavity : 2e-3;
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
    LabelledOrgan lung{"", Organ::lung, filled(scan.grid, closed(scan.grid, partOf(pieces.label, piece), 5e-3), true), scan.levels.clipped, 2e-3, 3.5e-3};
    double x = 0, count = 0;
    for (std::size_t n = 0; n < lung.mask.size(); ++n)
      if (lung.mask[n]) x += scan.place(n).x(), ++count;
    lung.id = "lung_" + sideOf(x / std::max(count, 1.0), midline_x);
    if (!lungs.empty() && lungs.front().id == lung.id) break;
    lungs.push_back(std::move(lung));
  }
  return lungs;
}

std::vector<LabelledOrgan> findThoraxBones(const Scan& scan, const std::vector<LabelledOrgan>& lungs, const Mask& taken, double midline_x,
                                           double front_y, double top_z) {
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
  Mask sternum = largestPiece(scan.grid, filled(scan.grid, closed(scan.grid, partOf(parted, 1), 4e-3), true));
  Mask ribs = filled(scan.grid, closed(scan.grid, partOf(parted, 2), 2e-3), true);
  for (std::size_t n = 0; n < ribs.size(); ++n) sternum[n] = sternum[n] && !taken[n], ribs[n] = ribs[n] && !sternum[n] && !taken[n];
  organs.push_back({"sternum", Organ::sternum, std::move(sternum), false, 1.5e-3, 2.5e-3});
  addRibs(scan, ribs, midline_x, &organs);
  return organs;
}

}  // namespace palpa::anatomy
