#pragma once

#include <array>

#include "anatomy/geometry/top_shape.h"
#include "apps/twin/phantom/phantom_table.h"

namespace palpa::twin {

/// What silicone does beside being elastic.
struct SiliconeLaw {
  std::array<double, 2> relaxes{
      0.06, 0.05};  ///< of the elastic force; what comes on top at once and goes
  std::array<double, 2> relaxation_time{0.05, 1.5};  ///< s
  double mu = 0.35;  ///< of Coulomb friction, sliding fast under 1 N
  /// Of mu, more when it hardly slides; m/s (Stribeck; steeper, a light hand would squeal)
  double sticks = 0.05, sticks_below = 0.02;
  double load_power = -0.05;  ///< mu ~ f_n^this: rubber's contact grows less than its load
  double sigma = 1500;        ///< N/m, before it slides
  double B = 0.4;             ///< N s/m, while it slides
};

/// A tool on a simulated phantom, as it truly is. Frame P of SoftBlock.
struct PhantomTouch {
  bool contact = false;
  Vec3 f = Vec3::Zero();     ///< N, on the tool: normal and friction
  Vec3 n = Vec3::UnitZ();    ///< outward: the way of the force without friction
  double f_n = 0, x = 0;     ///< N, without friction; m, how far the surface is pushed in
  Vec3 lump = Vec3::Zero();  ///< m, how far the lump has moved
};

/// One tool on silicone, from the elastic force on: relaxation (a Prony series on it), friction by
/// Dahl's differential equation taken in small parts.
class SiliconeContact {
 public:
  explicit SiliconeContact(const SiliconeLaw& law) : law_(law) {}
  /// The tool's lowest point is at `tip` after another `dt`, where `elastic`, N, pushes it back
  /// and the surface rubs `rubs` times as the law says; all but the lump is told.
  PhantomTouch step(const Vec3& elastic, const Vec3& tip, double dt, double rubs = 1);

 private:
  Vec3 drag(const PhantomTouch& touch, const Vec3& dp, double dt, double rubs);
  SiliconeLaw law_;
  double elastic_ = 0;
  std::array<double, 2> extra_{0, 0};  // N
  Vec3 last_ = Vec3::Zero(), drag_ = Vec3::Zero();
  bool started_ = false;
};

/// A simulated phantom under a moving tool: elasticity from finite elements, what else silicone
/// does on top. Frame P of SoftBlock.
class PhantomTwin {
 public:
  PhantomTwin(PhantomTable table, const SiliconeLaw& law)
      : table_(std::move(table)), contact_(law) {}
  /// The tool's lowest point is at `tip` after another `dt`.
  PhantomTouch step(const Vec3& tip, double dt);

 private:
  PhantomTable table_;
  SiliconeContact contact_;
};

/// A simulated phantom without a lump whose top is curved, under a moving round tip: the force of
/// the elements' flat block, by the depth d to which the tip's surface is below the nearest point
/// of the top, along the normal there, times Hertz's factor for two curved bodies (Hertz 1882):
///     F = F_flat(d) / sqrt(1 + r (k_1 + k_2) / 2)      k: the top's curvatures, 1/m; r: the tip's
/// radius. The middle of the block stands for every place: the elements were solved for no edge
/// and no slope. Friction along the top. Frame P.
class CurvedPhantomTwin {
 public:
  CurvedPhantomTwin(PhantomTable table, const SiliconeLaw& law, const TopShape& top)
      : table_(std::move(table)), contact_(law), top_(top) {}
  /// The middle of the tip is at `middle` after another `dt`.
  PhantomTouch step(const Vec3& middle, double dt);

 private:
  PhantomTable table_;
  SiliconeContact contact_;
  TopShape top_;
  Vec3 last_ = Vec3::Zero(), gone_ = Vec3::Zero();  // m; way along the top, in its own frame
  bool started_ = false;
};

/// The same under two tools side by side along x, the first `PairTable::apart` beyond the second,
/// in the plane y = 0.
class PhantomPairTwin {
 public:
  PhantomPairTwin(PhantomTable one, PairTable both, const SiliconeLaw& law)
      : one_(std::move(one)),
        both_(std::move(both)),
        contacts_{SiliconeContact(law), SiliconeContact(law)} {}
  /// Throws Error where the tools do not stand like this.
  std::array<PhantomTouch, 2> step(const std::array<Vec3, 2>& tips, double dt);

 private:
  PhantomTable one_;
  PairTable both_;
  std::array<SiliconeContact, 2> contacts_;
};

/// A phantom without a lump under two tools anywhere on it, like fingers. What both do more than
/// each alone is that of two side by side over the middle, along the line between them and less
/// the farther they are apart: by (apart/distance)^2, as the elements have it from 16 to 26 mm in
/// a block that is glued to a plate (a half space would sink by 1/distance beside a load); closer
/// than half of `apart` as there.
class PhantomFingersTwin {
 public:
  PhantomFingersTwin(PhantomTable one, PairTable both, const SiliconeLaw& law)
      : one_(std::move(one)),
        both_(std::move(both)),
        contacts_{SiliconeContact(law), SiliconeContact(law)} {}
  /// The first alone.
  PhantomTouch step(const Vec3& tip, double dt);
  std::array<PhantomTouch, 2> step(const std::array<Vec3, 2>& tips, double dt);

 private:
  PhantomTable one_;
  PairTable both_;
  std::array<SiliconeContact, 2> contacts_;
};

}  // namespace palpa::twin
