#include "anatomy/volume/segmentation.h"

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/dense_solvers.h"
#include "anatomy/volume/scan.h"

namespace palpa::anatomy {
namespace {

constexpr int kThresholds = 8;
constexpr double kHighest = 2.2;  // times the bone level above the soft tissue's
constexpr double kSeedReach = 8e-3, kWatershed = 4e-3, kMarrow = 6e-3, kThread = 4e-3;
constexpr double kRival = 3e-6;    // m^3
constexpr double kPerStep = 4e-3;  // a lower threshold is worth so much height

struct BoneShape {
  std::size_t voxels = 0;
  Vec3 mean = Vec3::Zero(), spread = Vec3::Zero();  // rms along the principal axes, longest first
  Vec3 along = Vec3::Zero();
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
};

std::vector<BoneShape> shapesOf(const Scan& scan, const VoxelPieces& pieces) {
  std::vector<BoneShape> shapes(pieces.voxels.size());
  std::vector<Mat3> second(shapes.size(), Mat3::Zero());
  for (std::size_t n = 0; n < pieces.label.size(); ++n) {
    const auto piece = static_cast<std::size_t>(pieces.label[n]);
    if (piece == 0) continue;
    const Vec3 p = scan.place(n);
    BoneShape& s = shapes[piece];
    ++s.voxels;
    s.mean += p;
    second[piece] += p * p.transpose();
    s.low = s.low.cwiseMin(p), s.high = s.high.cwiseMax(p);
  }
  for (std::size_t i = 1; i < shapes.size(); ++i) {
    const double count = static_cast<double>(shapes[i].voxels);
    shapes[i].mean /= count;
    const Mat3 covariance = second[i] / count - shapes[i].mean * shapes[i].mean.transpose();
    const SymmetricEigen<3> eigen = symmetricEigen(covariance);
    shapes[i].spread = eigen.values.reverse().cwiseMax(0).cwiseSqrt();
    shapes[i].along = eigen.vectors.col(2);
  }
  return shapes;
}

/// Rod-like, lateral, in the body's front half, near the midline at one end.
bool looksLikeClavicle(const BoneShape& s, double midline, double body_middle_y) {
  const double side = s.mean.x() < midline ? -1 : 1;
  const double medial = side < 0 ? midline - s.high.x() : s.low.x() - midline;
  const double lateral = side < 0 ? midline - s.low.x() : s.high.x() - midline;
  return s.spread[0] > 0.017 && s.spread[0] < 0.055 && s.spread[1] < 0.0095 &&
         s.spread[2] > 0.0027 && s.spread[2] < 0.008 && medial > -0.005 && medial < 0.045 &&
         lateral > 0.06 && s.mean.y() < body_middle_y && std::abs(s.along.x()) > 0.35;
}

/// All bone at one threshold, and which piece of it is meant.
struct Choice {
  VoxelPieces pieces;
  int piece = 0;
};

class Search {
 public:
  Search(const Scan& scan, const Mask& taken, const Seeds& seeds)
      : scan_(scan), taken_(taken), seeds_(seeds) {
    double y = 0, count = 0;
    for (std::size_t n = 0; n < scan.body.size(); n += 7)
      if (scan.body[n]) y += scan.place(n).y(), ++count;
    middle_y_ = y / std::max(count, 1.0);
  }

  std::optional<Clavicle3> find(Side side) const {
    const auto seed = seeds_.find(std::string("clavicle_") + name(side));
    const std::optional<Choice> choice =
        seed == seeds_.end() ? byShape(side) : bySeed(seed->second);
    if (!choice) return std::nullopt;
    return finished(*choice);
  }

 private:
  VoxelPieces piecesAt(int step) const {
    const double soft = scan_.levels.soft, bone = scan_.levels.bone;
    const double level = bone + (kHighest - 1) * (bone - soft) * step / (kThresholds - 1);
    Mask mask = scan_.above(level);
    for (std::size_t n = 0; n < mask.size(); ++n) mask[n] = mask[n] && !taken_[n];
    return piecesOf(scan_.grid, mask);
  }

  /// Of all thresholds the piece that lies highest (ribs of this shape lie lower), of those the one
  /// of the lowest threshold.
  std::optional<Choice> byShape(Side side) const {
    std::optional<Choice> best;
    double most = -1e9;
    for (int step = 0; step < kThresholds; ++step) {
      Choice choice{piecesAt(step), 0};
      const std::vector<BoneShape> shapes = shapesOf(scan_, choice.pieces);
      for (std::size_t i = 1; i < shapes.size(); ++i) {
        const BoneShape& s = shapes[i];
        if ((s.mean.x() < scan_.midline_x) != (side == Side::right) ||
            !looksLikeClavicle(s, scan_.midline_x, middle_y_))
          continue;
        const double worth = s.mean.z() + s.spread[0] - kPerStep * step;
        if (worth > most) most = worth, choice.piece = static_cast<int>(i);
      }
      if (choice.piece) best = std::move(choice);
    }
    return best;
  }

  std::optional<Choice> bySeed(const Vec3& seed_S) const {
    std::optional<Choice> loosest;
    for (int step = 0; step < kThresholds; ++step) {
      Choice choice{piecesAt(step), 0};
      choice.piece = pieceNear(choice.pieces, seed_S);
      if (!choice.piece) break;
      const BoneShape shape =
          shapesOf(scan_, choice.pieces)[static_cast<std::size_t>(choice.piece)];
      if (looksLikeClavicle(shape, scan_.midline_x, middle_y_)) return choice;
      if (!loosest || shape.spread[1] > 0.02)
        loosest = std::move(choice);  // still joined to others: the next one
    }
    return loosest;
  }

  int pieceNear(const VoxelPieces& pieces, const Vec3& seed_S) const {
    const Index3 at = scan_.cellAt(seed_S);
    int found = 0;
    double nearest = kSeedReach;
    Index3 reach{};
    for (std::size_t a = 0; a < 3; ++a)
      reach[a] = static_cast<int>(kSeedReach / scan_.grid.spacing[static_cast<int>(a)]);
    for (int k = -reach[2]; k <= reach[2]; ++k)
      for (int j = -reach[1]; j <= reach[1]; ++j)
        for (int i = -reach[0]; i <= reach[0]; ++i) {
          const Index3 c{at[0] + i, at[1] + j, at[2] + k};
          if (!scan_.grid.holds(c)) continue;
          const int piece = pieces.label[scan_.grid.index(c)];
          const double distance = (scan_.place(c) - seed_S).norm();
          if (piece && pieces.voxels[static_cast<std::size_t>(piece)] > 20 && distance < nearest)
            nearest = distance, found = piece;
        }
    return found;
  }

  /// The piece grown back to the lowest threshold against its neighbours, filled, with its axis.
  Clavicle3 finished(const Choice& choice) const {
    Mask within = scan_.above(scan_.levels.bone);
    for (std::size_t n = 0; n < within.size(); ++n) within[n] = within[n] && !taken_[n];
    std::vector<std::int32_t> markers = choice.pieces.label;
    for (std::int32_t& m : markers)  // crumbs of spongy bone are nobody's rivals
      if (static_cast<double>(choice.pieces.voxels[static_cast<std::size_t>(m)]) *
              scan_.grid.spacing.prod() <
          kRival)
        m = 0;
    const std::vector<std::int32_t> parted =
        grown(scan_.grid, std::move(markers), within, kWatershed);
    Clavicle3 clavicle;
    clavicle.mask.resize(parted.size());
    Mask others(parted.size());
    for (std::size_t n = 0; n < parted.size(); ++n) {
      clavicle.mask[n] = parted[n] == choice.piece;
      others[n] = within[n] && parted[n] != choice.piece;
    }
    Mask whole = filled(scan_.grid, closed(scan_.grid, clavicle.mask, kMarrow), true);
    for (std::size_t n = 0; n < whole.size(); ++n) whole[n] = whole[n] && !others[n] && !taken_[n];
    clavicle.mask = withoutThreads(whole);
    clavicle.axis_S = centreLine(scan_, clavicle.mask);
    const auto off = [&](const Vec3& p) { return std::abs(p.x() - scan_.midline_x); };
    if (off(clavicle.axis_S.front()) > off(clavicle.axis_S.back()))
      std::reverse(clavicle.axis_S.begin(), clavicle.axis_S.end());
    for (std::size_t i = 1; i < clavicle.axis_S.size(); ++i)
      clavicle.length += (clavicle.axis_S[i] - clavicle.axis_S[i - 1]).norm();
    clavicle.leaves_volume = leaves(clavicle);
    clavicle.seed_S = clavicle.axis_S[clavicle.axis_S.size() / 2];
    return clavicle;
  }

  /// Without the vessels that hang on it: what no ball of 4 mm fits into, except within 2 mm of
  /// what one does.
  Mask withoutThreads(const Mask& whole) const {
    const Mask core = largestPiece(scan_.grid, opened(scan_.grid, whole, kThread));
    std::vector<std::int32_t> marked(core.begin(), core.end());
    marked = grown(scan_.grid, std::move(marked), whole, kThread / 2);
    return Mask(marked.begin(), marked.end());
  }

  bool leaves(const Clavicle3& clavicle) const {
    for (std::size_t n = 0; n < clavicle.mask.size(); ++n)
      if (clavicle.mask[n] && scan_.grid.atBorder(scan_.grid.cell(n))) return true;
    return false;
  }

  const Scan& scan_;
  const Mask& taken_;
  const Seeds& seeds_;
  double middle_y_ = 0;
};

}  // namespace

Clavicles findClavicles(const Scan& scan, const Mask& taken, const Seeds& seeds) {
  const Search search(scan, taken, seeds);
  return {search.find(Side::right), search.find(Side::left)};
}

}  // namespace palpa::anatomy
