#include "apps/twin/hand_motion.h"

#include "anatomy/base/random.h"

namespace palpa::twin {
namespace {

constexpr double kLedAbove = 2e-3;  // m

}  // namespace

LedTip& LedTip::go(const Vec3& to, double seconds, double hold) {
  const double arrival = duration() + seconds;
  stops_.push_back({to, arrival, arrival + hold});
  at_ = to;
  return *this;
}

LedTip& LedTip::press(const Vec3& place, double depth, double seconds_down, double hold) {
  const Vec3 above(place.x(), place.y(), kLedAbove);
  if ((at_ - above).norm() > 0) go(above, 0.3);
  go(Vec3(place.x(), place.y(), -depth), seconds_down, hold);
  return go(above, seconds_down);
}

Vec3 LedTip::at(double t) const {
  std::size_t i = 0;
  while (i + 1 < stops_.size() && t >= stops_[i].until) ++i;
  if (i == 0 || t >= stops_[i].arrival) return stops_[i].p;
  const Stop& from = stops_[i - 1];
  return MinJerk(makePose(Mat3::Identity(), from.p), makePose(Mat3::Identity(), stops_[i].p),
                 from.until, stops_[i].arrival - from.until)
      .at(t)
      .translation();
}

LedTip pressing(const Vec3& place, double deep, std::uint64_t seed) {
  RandomStream random(seed, "bench.pressing");
  LedTip tip(Vec3(place.x(), place.y(), kLedAbove));
  for (int i = 0; i < 10; ++i)
    tip.press(place, deep * random.uniform(0.5, 1.0), random.uniform(0.15, 0.8),
              random.uniform(0.0, 0.3));
  return tip;
}

LedTip tapping(const Vec3& place, double deep, std::uint64_t seed) {
  RandomStream random(seed, "bench.tapping");
  LedTip tip(Vec3(place.x(), place.y(), kLedAbove));
  for (int i = 0; i < 16; ++i)
    tip.press(place, deep * random.uniform(0.4, 0.8), random.uniform(0.08, 0.14));
  return tip;
}

LedTip stroking(const Vec3& place, double deep, double reach, const Vec3& way, std::uint64_t seed) {
  RandomStream random(seed, "bench.stroking");
  const Vec3 before = place - reach * way, beyond = place + reach * way;
  LedTip tip(Vec3(before.x(), before.y(), kLedAbove));
  for (int i = 0; i < 4; ++i) {
    const Vec3 below(0, 0, -deep * random.uniform(0.5, 1.0));
    tip.go(before + below, 0.4);
    for (int j = 0; j < 2; ++j)
      tip.go(beyond + below, random.uniform(0.4, 1.2)).go(before + below, random.uniform(0.4, 1.2));
    tip.go(before + kLedAbove * Vec3::UnitZ(), 0.4);
  }
  return tip;
}

}  // namespace palpa::twin
