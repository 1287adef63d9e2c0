#include "apps/assess/force_balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::assess {
namespace {

constexpr std::size_t kHalf_ticks = 20, kLongestDelay_ticks = 20;
using Stretch = std::vector<haptics::FlightRecord>;

bool complete(const haptics::FlightRecord& tick) {
  return tick.reading.instrumented && tick.reading.homed &&
         tick.sensed.state == haptics::SensorState::valid;
}

/// Without gaps, all of it recorded.
std::vector<Stretch> stretchesOf(const std::vector<haptics::FlightRecord>& ticks) {
  std::vector<Stretch> all;
  for (const haptics::FlightRecord& tick : ticks) {
    if (!complete(tick)) continue;
    if (all.empty() || tick.tick != all.back().back().tick + 1) all.emplace_back();
    all.back().push_back(tick);
  }
  return all;
}

double periodOf(const Stretch& stretch) {
  return 1e-9 * static_cast<double>(stretch.back().t_ns - stretch.front().t_ns) /
         static_cast<double>(stretch.size() - 1);
}

/// How many ticks the sensed point's motion is behind the tool's: where their ways over a window
/// differ least.
std::size_t delayOf(const std::vector<Stretch>& stretches) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t delay = 0; delay <= kLongestDelay_ticks; ++delay) {
    double sum = 0;
    for (const Stretch& s : stretches) {
      for (std::size_t i = 0; i + kHalf_ticks + delay < s.size(); ++i) {
        const Vec3 tool = unpack(s[i + kHalf_ticks].reading.p_DE) - unpack(s[i].reading.p_DE);
        const Vec3 point =
            unpack(s[i + kHalf_ticks + delay].sensed.p_DK) - unpack(s[i + delay].sensed.p_DK);
        sum += (tool - point).squaredNorm();
      }
    }
    if (sum < least) least = sum, best = delay;
  }
  return best;
}

}  // namespace

ForceBalance balanceOf(const std::vector<haptics::FlightRecord>& ticks, double mass) {
  const std::vector<Stretch> stretches = stretchesOf(ticks);
  const std::size_t delay = delayOf(stretches);
  ForceBalance balance;
  double sum2 = 0;
  for (const Stretch& s : stretches) {
    if (s.size() < 2 * kHalf_ticks + delay + 2) continue;
    const double period = periodOf(s), T = static_cast<double>(kHalf_ticks) * period;
    balance.delay_s = static_cast<double>(delay) * period;
    for (std::size_t i = kHalf_ticks; i + kHalf_ticks + delay < s.size(); ++i) {
      Vec3 forces = Vec3::Zero(), object = Vec3::Zero();
      for (std::size_t k = i - kHalf_ticks + 1; k < i + kHalf_ticks; ++k) {
        const double share = (static_cast<double>(kHalf_ticks) -
                              std::abs(static_cast<double>(k) - static_cast<double>(i))) /
                             static_cast<double>(kHalf_ticks * kHalf_ticks);
        object += share * unpack(s[k + delay].sensed.f_D);
        forces += share * (unpack(s[k].reading.f_hand_D) + unpack(s[k].reading.f_device_D));
      }
      const Vec3 a = (unpack(s[i + kHalf_ticks].reading.p_DE) - 2 * unpack(s[i].reading.p_DE) +
                      unpack(s[i - kHalf_ticks].reading.p_DE)) /
                     (T * T);
      const double residual = (forces + object - mass * a).norm();
      balance.largest_N = std::max(balance.largest_N, residual);
      balance.object_N = std::max(balance.object_N, object.norm());
      sum2 += residual * residual;
      ++balance.samples;
    }
  }
  if (balance.samples > 0) balance.rms_N = std::sqrt(sum2 / static_cast<double>(balance.samples));
  return balance;
}

}  // namespace palpa::assess
