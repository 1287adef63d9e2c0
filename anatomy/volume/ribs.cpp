#include "anatomy/volume/segmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpa::anatomy {
namespace {

constexpr double kCrumb = 0.25e-6, kLeastRib = 1.0e-6;  // m^3
constexpr double kLeastLength = 25e-3;
constexpr double kBin = 0.12;  // rad about the lung's middle
constexpr double kGap = 30e-3,
                 kBridge = 3.2e-3;  // widest between pieces of one rib; radius of what joins them
constexpr double kAside = 6e-3, kTurn = 0.45;  // an end may lie so far off the other's direction
constexpr double kAtSpine = 85e-3;             // half width in which ribs begin

/// A piece of a rib, or several: its middle line from behind forward.
struct RibPiece {
  std::vector<std::size_t> voxels;
  std::vector<Vec3> line;

  Vec3 back() const { return line.front(); }
  Vec3 front() const { return line.back(); }
  Vec3 heading(bool at_front) const {  // outward at an end
    const std::size_t last = line.size() - 1, inner = std::min<std::size_t>(2, last);
    const Vec3 d = at_front ? Vec3(line[last] - line[last - inner]) : Vec3(line[0] - line[inner]);
    return d.norm() > 1e-6 ? Vec3(d.normalized()) : Vec3(Vec3::Zero());
  }
  double length() const {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
    return sum;
  }
};

class RibCage {
 public:
  RibCage(const Scan& scan, const LabelledOrgan& lung, double midline_x)
      : scan_(scan), midline_x_(midline_x) {
    double count = 0;
    for (std::size_t n = 0; n < lung.mask.size(); n += 5)
      if (lung.mask[n]) middle_ += scan.place(n), ++count;
    middle_ /= std::max(count, 1.0);
    side_ = middle_.x() < midline_x ? -1 : 1;
  }

  void add(std::vector<std::size_t> voxels) {
    if (volume(voxels) < kCrumb) return;
    RibPiece rod{std::move(voxels), {}};
    findLine(&rod);
    rods_.push_back(std::move(rod));
  }
  bool holds(const Vec3& p) const { return (p.x() - midline_x_) * side_ > 0; }

  /// The two nearest ends that face each other, until no such pair is left.
  void join() {
    for (;;) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t rear = 0, fore = 0;
      for (std::size_t a = 0; a < rods_.size(); ++a)
        for (std::size_t b = 0; b < rods_.size(); ++b)
          if (const double gap = a == b ? kGap : gapBetween(rods_[a], rods_[b]);
              gap < std::min(least, kGap))
            least = gap, rear = a, fore = b;
      if (!std::isfinite(least)) return;
      RibPiece& whole = rods_[rear];
      bridge(whole.front(), rods_[fore].back(), &whole.voxels);
      whole.voxels.insert(whole.voxels.end(), rods_[fore].voxels.begin(), rods_[fore].voxels.end());
      whole.line.insert(whole.line.end(), rods_[fore].line.begin(), rods_[fore].line.end());
      rods_.erase(rods_.begin() + static_cast<std::ptrdiff_t>(fore));
    }
  }

  void name(std::vector<LabelledOrgan>* organs) {
    const auto too_small = [&](const RibPiece& rod) {
      return volume(rod.voxels) < kLeastRib || rod.length() < kLeastLength;
    };
    std::erase_if(rods_, too_small);
    std::stable_sort(rods_.begin(), rods_.end(), [](const RibPiece& a, const RibPiece& b) {
      return a.back().z() > b.back().z();
    });
    int ribs = 0, pieces = 0;
    for (const RibPiece& rod : rods_) {
      const bool whole =
          std::abs(rod.back().x() - midline_x_) < kAtSpine && rod.back().y() > middle_.y();
      const std::string id =
          whole ? "rib_" + std::to_string(++ribs) : "rib_piece_" + std::to_string(++pieces);
      LabelledOrgan organ{id + (side_ < 0 ? "_right" : "_left"),
                          Organ::rib,
                          Mask(scan_.body.size(), 0),
                          false,
                          1.3e-3,
                          2.0e-3};
      for (const std::size_t n : rod.voxels) organ.mask[n] = 1;
      organs->push_back(std::move(organ));
    }
  }

 private:
  double volume(const std::vector<std::size_t>& voxels) const {
    return static_cast<double>(voxels.size()) * scan_.grid.spacing.prod();
  }

  /// 0 at the spine, growing round the side to the sternum.
  double angleOf(const Vec3& p) const {
    return std::atan2(side_ * (p.x() - middle_.x()), p.y() - middle_.y()) + 1.2;
  }

  void findLine(RibPiece* rod) const {
    constexpr int kBins = static_cast<int>(2 * std::numbers::pi / kBin) + 1;
    std::vector<Vec3> sum(kBins, Vec3::Zero());
    std::vector<double> count(kBins, 0);
    for (const std::size_t n : rod->voxels) {
      const Vec3 p = scan_.place(n);
      const double angle = std::fmod(angleOf(p) + 2 * std::numbers::pi, 2 * std::numbers::pi);
      const auto bin = static_cast<std::size_t>(angle / kBin);
      sum[bin] += p, ++count[bin];
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (count[i] > 0) rod->line.push_back(sum[i] / count[i]);
  }

  /// From `rear`'s front end to `fore`'s back end; infinite where they do not face each other.
  static double gapBetween(const RibPiece& rear, const RibPiece& fore) {
    const Vec3 way = fore.back() - rear.front();
    const double gap = way.norm();
    const auto aside = [&](const Vec3& heading, const Vec3& to) {
      return to.dot(heading) < -kAside ? kGap : (to - to.dot(heading) * heading).norm();
    };
    const double most = kAside + kTurn * gap;
    const bool facing =
        aside(rear.heading(true), way) < most && aside(fore.heading(false), -way) < most;
    return facing ? gap : std::numeric_limits<double>::infinity();
  }

  void bridge(const Vec3& from, const Vec3& to, std::vector<std::size_t>* voxels) const {
    const int steps = std::max(2, static_cast<int>((to - from).norm() / 1e-3));
    for (int i = 0; i <= steps; ++i) {
      const Vec3 p = from + (to - from) * i / steps;
      const Index3 at = scan_.cellAt(p);
      Index3 reach{};
      for (std::size_t a = 0; a < 3; ++a)
        reach[a] = static_cast<int>(std::ceil(kBridge / scan_.grid.spacing[static_cast<int>(a)]));
      for (int z = -reach[2]; z <= reach[2]; ++z)
        for (int y = -reach[1]; y <= reach[1]; ++y)
          for (int x = -reach[0]; x <= reach[0]; ++x) {
            const Index3 c{at[0] + x, at[1] + y, at[2] + z};
            if (scan_.grid.holds(c) && (scan_.place(c) - p).norm() <= kBridge)
              voxels->push_back(scan_.grid.index(c));
          }
    }
  }

  const Scan& scan_;
  double midline_x_, side_ = 1;
  Vec3 middle_ = Vec3::Zero();
  std::vector<RibPiece> rods_;
};

}  // namespace

void addRibs(const Scan& scan, const Mask& ribs, const std::vector<LabelledOrgan>& lungs,
             double midline_x, std::vector<LabelledOrgan>* organs) {
  const VoxelPieces pieces = piecesOf(scan.grid, ribs);
  std::vector<std::vector<std::size_t>> voxels(pieces.voxels.size());
  for (std::size_t n = 0; n < ribs.size(); ++n)
    if (pieces.label[n]) voxels[static_cast<std::size_t>(pieces.label[n])].push_back(n);
  for (const LabelledOrgan& lung : lungs) {
    RibCage cage(scan, lung, midline_x);
    for (std::size_t i = 1; i < voxels.size(); ++i)
      if (cage.holds(scan.place(voxels[i][voxels[i].size() / 2]))) cage.add(voxels[i]);
    cage.join();
    cage.name(organs);
  }
}

}  // namespace palpa::anatomy
