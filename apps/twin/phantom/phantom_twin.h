#pragma once

#include <array>

#include "apps/twin/phantom/phantom_table.h"

namespace palpa::twin {

/// What silicone does beside being elastic.
struct SiliconeLaw {
  std::array<double, 2> relaxes{0.06, 0.05};        ///< of the elastic force; what comes on top at once and goes
  std::array<double, 2> relaxation_time{0.05, 1.5}; ///< s
  double mu = 0.35;                                 ///< of Coulomb friction, sliding fast under 1 N
  double sticks = 0.05, sticks_below = 0.02;        ///< of mu, more when it hardly slides; m/s (Stribeck; steeper, a light hand would squeal)
  double load_power = -0.05;                        ///< mu ~ f_n^this: rubber's contact grows less than its load
  double sigma = 1500;                              ///< N/m, before it slides
  double B = 0.4;                                   ///< N s/m, while it slides
};

/// A simulated phantom under a moving tool: elasticity from finite elements, relaxation (a Prony series on the elastic force), friction by Dahl's differential equation taken in small parts.
/// Frame P of SoftBlock.
class PhantomTwin {
 public:
  PhantomTwin(PhantomTable table, const SiliconeLaw& law) : table_(std::move(table)), law_(law) {}

  struct Touch {
    bool contact = false;
    Vec3 f = Vec3::Zero();                  ///< N, on the tool: normal and friction
    Vec3 n = Vec3::UnitZ();                 ///< outward: the way of the force without friction
    double f_n = 0, x = 0;                  ///< N, without friction; m, how far the surface is pushed in
    Vec3 lump = Vec3::Zero();               ///< m, how far the lump has moved
  };
  /// The tool's lowest point is at `tip` after another `dt`.
  Touch step(const Vec3& tip, double dt);

 private:
  Vec3 drag(const Touch& touch, const Vec3& dp, double dt);
  PhantomTable table_;
  SiliconeLaw law_;
  double elastic_ = 0;
  std::array<double, 2> extra_{0, 0};       // N
  Vec3 last_ = Vec3::Zero(), drag_ = Vec3::Zero();
  bool started_ = false;
};

}  // namespace palpa::twin
