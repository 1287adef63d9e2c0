#include "anatomy/volume/segmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/base/error.h"
#include "anatomy/volume/scan.h"

namespace palpa::anatomy {
namespace {

constexpr double kCore = 2.4e-3;   // a ball of this radius fits into the lumen, into no cortex
constexpr double kCavaOff = 0.05;  // the vena cava lies no farther from the midline
constexpr double kNearest = 0.055, kFarthest = 0.115;  // of the armpit's seed from the midline
constexpr double kThinnestLumen = 2.5e-3, kWidestLumen = 7.5e-3;
constexpr double kOverRadius = 1.3, kSlack = 1.0e-3;  // growth about the line
constexpr double kBlooming = 5e-3;
constexpr double kSnap = 6e-3;
constexpr double kLineSmoothing = 8e-3;

class VeinSearch {
 public:
  explicit VeinSearch(const Scan& scan)
      : scan_(scan),
        dense_(scan.above(scan.levels.dense)),
        depth_(distanceTo(scan.grid, inverted(dense_))) {
    Mask core(dense_.size());
    for (std::size_t n = 0; n < core.size(); ++n) core[n] = depth_[n] >= kCore;
    cores_ = piecesOf(scan.grid, core);
  }

  std::optional<Vein> run(const Seeds& given) const {
    std::size_t cava = 0, axilla = 0;
    if (!seedOr(
            given, "vein_svc", [&] { return cavaSeed(); }, &cava))
      return std::nullopt;
    if (!seedOr(
            given, "vein_axilla", [&] { return axillaSeed(scan_.place(cava)); }, &axilla))
      return std::nullopt;
    Vein vein;
    const std::vector<std::size_t> path = cheapestPath(scan_.grid, cost(), axilla, cava);
    std::vector<Vec3> points;
    for (const std::size_t n : path) points.push_back(scan_.place(n));
    vein.line_S = smoothLine(points, kLineSmoothing);
    for (const Vec3& p : vein.line_S) vein.radius.push_back(ballNear(p));
    evenOut(&vein.radius);
    vein.mask = lumen(vein);
    Mask cores(dense_.size());
    for (std::size_t n = 0; n < cores.size(); ++n) cores[n] = cores_.label[n] != 0;
    vein.contrast = dilated(scan_.grid, cores, kBlooming);
    vein.side = points.front().x() < scan_.midline_x ? Side::right : Side::left;
    vein.seeds = {{"vein_svc", scan_.place(cava)}, {"vein_axilla", scan_.place(axilla)}};
    return vein;
  }

 private:
  template <class Propose>
  bool seedOr(const Seeds& given, const char* key, Propose propose, std::size_t* seed) const {
    const auto found = given.find(key);
    const std::optional<std::size_t> place =
        found == given.end() ? propose() : snapped(found->second, key);
    if (place) *seed = *place;
    return place.has_value();
  }

  /// The deepest dense voxel near a seed that somebody gave.
  std::optional<std::size_t> snapped(const Vec3& p_S, const char* key) const {
    std::optional<std::size_t> best;
    forBall(p_S, kSnap, [&](std::size_t n) {
      if (dense_[n] && (!best || depth_[n] > depth_[*best])) best = n;
    });
    if (!best)
      throw Error("there is no contrast within 6 mm", std::string("seed point ") + key,
                  "Move the point into the bright vein, or lower --vein-level");
    return best;
  }

  template <class Visit>
  void forBall(const Vec3& p_S, double radius, Visit visit) const {
    const Index3 at = scan_.cellAt(p_S);
    Index3 reach{};
    for (std::size_t a = 0; a < 3; ++a)
      reach[a] = static_cast<int>(std::ceil(radius / scan_.grid.spacing[static_cast<int>(a)]));
    for (int k = at[2] - reach[2]; k <= at[2] + reach[2]; ++k)
      for (int j = at[1] - reach[1]; j <= at[1] + reach[1]; ++j)
        for (int i = at[0] - reach[0]; i <= at[0] + reach[0]; ++i)
          if (scan_.grid.holds({i, j, k}) && (scan_.place(Index3{i, j, k}) - p_S).norm() <= radius)
            visit(scan_.grid.index({i, j, k}));
  }

  // The tallest core by the midline; in it, its deepest voxel a third down.
  std::optional<std::size_t> cavaSeed() const {
    struct Reach {
      double low = 1e9, high = -1e9;
    };
    std::vector<Reach> reach(cores_.voxels.size());
    for (std::size_t n = 0; n < dense_.size(); ++n) {
      const auto piece = static_cast<std::size_t>(cores_.label[n]);
      const Vec3 p = scan_.place(n);
      if (!piece || std::abs(p.x() - scan_.midline_x) > kCavaOff) continue;
      reach[piece].low = std::min(reach[piece].low, p.z()),
      reach[piece].high = std::max(reach[piece].high, p.z());
    }
    std::size_t tallest = 0;
    for (std::size_t i = 1; i < reach.size(); ++i)
      if (reach[i].high - reach[i].low > std::max(reach[tallest].high - reach[tallest].low, 0.02))
        tallest = i;
    if (!tallest) return std::nullopt;
    const double level =
        reach[tallest].high - std::min(0.05, 0.6 * (reach[tallest].high - reach[tallest].low));
    std::optional<std::size_t> best;
    for (std::size_t n = 0; n < dense_.size(); ++n) {
      if (cores_.label[n] != static_cast<std::int32_t>(tallest)) continue;
      const Vec3 p = scan_.place(n);
      if (std::abs(p.z() - level) > scan_.grid.spacing[2] ||
          std::abs(p.x() - scan_.midline_x) > kCavaOff)
        continue;
      if (!best || depth_[n] > depth_[*best]) best = n;
    }
    return best;
  }

  // Cores in the armpit's range: the side that has more, there the one farthest out that is no
  // thinner than the lumen.
  std::optional<std::size_t> axillaSeed(const Vec3& cava_S) const {
    std::optional<std::size_t> best[2];
    double much[2] = {0, 0};
    for (std::size_t n = 0; n < dense_.size(); ++n) {
      if (!cores_.label[n]) continue;
      const Vec3 p = scan_.place(n);
      const double off = std::abs(p.x() - scan_.midline_x);
      if (off < kNearest || off > kFarthest || std::abs(p.y() - cava_S.y()) > 0.08) continue;
      const std::size_t side = p.x() > scan_.midline_x;
      ++much[side];
      if (cores_.voxels[static_cast<std::size_t>(cores_.label[n])] < 20) continue;
      const auto worth = [&](std::size_t m) {
        return std::abs(scan_.place(m).x() - scan_.midline_x) + 3 * depth_[m];
      };
      if (!best[side] || worth(n) > worth(*best[side])) best[side] = n;
    }
    const std::size_t side = much[1] > much[0];
    return best[side] ? best[side] : best[1 - side];
  }

  /// Low where a ball's surroundings are all bright: marrow makes bone dearer than an even lumen.
  Values cost() const {
    const Values mean = blurred(scan_.grid, scan_.volume.values, 2e-3);
    Values cost(mean.size(), std::numeric_limits<float>::infinity());
    for (std::size_t n = 0; n < cost.size(); ++n) {
      if (!scan_.body[n]) continue;
      const double bright = std::clamp(
          (mean[n] - scan_.levels.soft) / (scan_.levels.dense - scan_.levels.soft), 0.0, 1.0);
      const double centred = 1 + std::exp(-depth_[n] / 1.5e-3);
      cost[n] = static_cast<float>(centred / (0.01 + std::pow(bright, 3)));
    }
    return cost;
  }

  double ballNear(const Vec3& p_S) const {
    double depth = 0;
    forBall(p_S, 2.5e-3,
            [&](std::size_t n) { depth = std::max(depth, static_cast<double>(depth_[n])); });
    return std::clamp(depth - scan_.grid.spacing.minCoeff() / 2, kThinnestLumen, kWidestLumen);
  }

  static void evenOut(std::vector<double>* radius) {
    for (int pass = 0; pass < 4; ++pass) {
      std::vector<double> before = *radius;
      for (std::size_t i = 1; i + 1 < radius->size(); ++i)
        (*radius)[i] = (before[i - 1] + 2 * before[i] + before[i + 1]) / 4;
    }
  }

  /// The balls along the line, so that it is one tube, and what is bright a little beyond them.
  Mask lumen(const Vein& vein) const {
    Mask mask(dense_.size(), 0);
    for (std::size_t i = 0; i < vein.line_S.size(); ++i) {
      const double radius = vein.radius[i];
      forBall(vein.line_S[i], kOverRadius * radius + kSlack, [&](std::size_t n) {
        if (dense_[n] || (scan_.place(n) - vein.line_S[i]).norm() <= radius) mask[n] = 1;
      });
    }
    return largestPiece(scan_.grid, mask);
  }

  const Scan& scan_;
  Mask dense_;
  Values depth_;
  VoxelPieces cores_;
};

}  // namespace

std::optional<Vein> findVein(const Scan& scan, const Seeds& seeds) {
  return VeinSearch(scan).run(seeds);
}

}  // namespace palpa::anatomy
