#include "apps/task_palpation/sensor_check.h"

#include <algorithm>
#include <cstdio>

#include "anatomy/base/quantile.h"

namespace palpa::task_palpation {
namespace {

constexpr double kInAir = 4e-3, kBelow = -2e-3, kPressed = 3e-3;  // m
constexpr double kAir_s = 0.1, kReversed_s = 0.1, kGap_s = 0.1;
constexpr std::size_t kPresses = 5;
constexpr double kLeast = 0.5, kMost = 2;

std::string with(const char* pattern, double number) {
  char text[192];
  std::snprintf(text, sizeof text, pattern, number);
  return text;
}

}  // namespace

SensorCheck::SensorCheck(const haptics::TickConfig& config)
    : X_PD_(unpack(config.X_DP).inverse()),
      top_(config.top),
      radius_(config.touch.tip_radius),
      law_(config.touch.surface.contact),
      map_(config.touch.map) {}

void SensorCheck::reset() {
  air_s_ = reversed_s_ = deepest_ = ratio_ = 0;
  last_ns_ = -1;
  ratios_.clear();
}

SensorCheck::Sensed SensorCheck::sensedIn(const haptics::FlightRecord& record) const {
  const Vec3 p_P = X_PD_ * unpack(record.sensed.p_DK),
             f_P = X_PD_.linear() * unpack(record.sensed.f_D);
  const TopFoot foot = nearestOn(top_, p_P);
  return {foot.over - radius_, p_P,
          top_.flat() ? f_P : Vec3(turnToNormal(foot.n).transpose() * f_P)};
}

double SensorCheck::inTheAir(const haptics::FlightRecord& record) const {
  const Sensed now = sensedIn(record);
  return now.height > kInAir ? now.f_P.norm() : 0;
}

/// At its deepest a press hardly moves: there the law needs no rate.
std::string SensorCheck::pressed(const Sensed& now) {
  const double depth = -now.height;
  if (depth > std::max(deepest_, kPressed)) {
    deepest_ = depth;
    const haptics::HuntCrossley here = haptics::lawAt(law_, map_, now.p_P).real;
    ratio_ = now.f_P.z() / haptics::forceOf(here, depth - law_.x0, 0);
  }
  if (depth > 0 || deepest_ == 0) return "";
  ratios_.push_back(ratio_);
  deepest_ = 0;
  if (ratios_.size() > kPresses) ratios_.erase(ratios_.begin());
  if (ratios_.size() < kPresses) return "";
  const double ratio = upperMedian(ratios_);
  if (ratio >= kLeast && ratio <= kMost) return "";
  return with(
      "the force sensor shows %.1f times what this silicone gives: wrong scale, or another "
      "phantom, or it lies elsewhere. Look at the sensor's settings, register the phantom again",
      ratio);
}

std::string SensorCheck::add(const haptics::FlightRecord& record) {
  const double dt = last_ns_ < 0 ? 0 : 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  last_ns_ = record.t_ns;
  if (record.sensed.state != haptics::SensorState::valid || dt <= 0 || dt > kGap_s) return "";
  const Sensed now = sensedIn(record);
  air_s_ = now.height > kInAir && now.f_P.norm() > law_.least_contact ? air_s_ + dt : 0;
  if (air_s_ > kAir_s)
    return with(
        "the force sensor shows %.1f N though nothing is touched: it has drifted, or its scale is "
        "wrong. Zero it again",
        now.f_P.norm());
  reversed_s_ = now.height < kBelow && now.f_P.z() < -law_.least_contact ? reversed_s_ + dt : 0;
  if (reversed_s_ > kReversed_s)
    return "the force sensor says that the phantom pulls where it is pressed: its sign is wrong. "
           "Look at the sensor's settings";
  return pressed(now);
}

}  // namespace palpa::task_palpation
