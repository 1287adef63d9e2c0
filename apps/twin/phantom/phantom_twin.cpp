#include "apps/twin/phantom/phantom_twin.h"

#include <algorithm>

#include "anatomy/geometry/error.h"

namespace palpa::twin {

PhantomTouch PhantomTwin::step(const Vec3& tip, double dt) {
  const double away = tip.head<2>().norm();
  const Vec3 out = away > 0 ? Vec3(tip.x() / away, tip.y() / away, 0) : Vec3(Vec3::UnitX());
  const PhantomTable::Cell cell = table_.at(away, std::max(0.0, -tip.z()));
  PhantomTouch touch = contact_.step(cell.f_out * out + cell.f_up * Vec3::UnitZ(), tip, dt);
  touch.lump = cell.lump_out * out + cell.lump_up * Vec3::UnitZ();
  return touch;
}

std::array<PhantomTouch, 2> PhantomPairTwin::step(const std::array<Vec3, 2>& tips, double dt) {
  constexpr double kLevel = 1e-6;  // m
  const Vec3 between = tips[0] - tips[1];
  if (std::abs(between.x() - both_.apart) > kLevel || std::abs(between.y()) > kLevel ||
      std::abs(tips[0].y()) > kLevel)
    throw Error("two tools on a simulated phantom must stay side by side over its middle",
                "phantom", "lead them so");
  const PairCell cell = both_.at(one_, 0.5 * (tips[0].x() + tips[1].x()),
                                 {std::max(0.0, -tips[0].z()), std::max(0.0, -tips[1].z())});
  std::array<PhantomTouch, 2> touches;
  for (std::size_t t = 0; t < 2; ++t) {
    touches[t] = contacts_[t].step(Vec3(cell.f[t].x(), 0, cell.f[t].y()), tips[t], dt);
    touches[t].lump = Vec3(cell.lump.x(), 0, cell.lump.y());
  }
  return touches;
}

}  // namespace palpa::twin
