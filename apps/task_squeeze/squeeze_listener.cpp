#include "apps/task_squeeze/squeeze_listener.h"

#include <algorithm>
#include <cmath>

namespace palpa::task_squeeze {
namespace {

constexpr double kLongestGap_s = 0.1,
                 kGrip_s = 0.1;  // longer: it was paused; shorter: it was no grip

double sensedN(const haptics::FlightRecord& r) {
  return r.sensed.state == haptics::SensorState::valid ? unpack(r.sensed.f_D).norm() : 0;
}
double feltN(const haptics::FlightRecord& r) {
  return (unpack(r.sensed.f_D) + unpack(r.f_command_D)).norm();
}

}  // namespace

void tellLoop(const Comparison& comparison, int thing, haptics::TickCommands* commands) {
  const auto factor = static_cast<float>(comparison.factors[static_cast<std::size_t>(thing)]);
  commands->squeeze_stiffness =
      comparison.property == assess::SqueezedProperty::stiffness ? factor : 1;
  commands->squeeze_weight = comparison.property == assess::SqueezedProperty::weight ? factor : 1;
}

void SqueezeListener::begin(std::uint32_t trial, const Comparison& comparison) {
  *this = SqueezeListener(touch_);
  trial_ = trial;
  comparison_ = comparison;
}

int SqueezeListener::thing(const haptics::TickCommands& commands) const {
  haptics::TickCommands second;
  tellLoop(comparison_, 1, &second);
  return commands.squeeze_stiffness == second.squeeze_stiffness &&
                 commands.squeeze_weight == second.squeeze_weight
             ? 1
             : 0;
}

void SqueezeListener::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_ || !record.commands.armed) return;
  if (record.tool == 0) {
    first_ = record;
    return;
  }
  const double dt = last_ns_ < 0 ? 0 : 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  last_ns_ = record.t_ns;
  if (dt <= 0 || dt > kLongestGap_s) return;
  seconds_ += dt;
  const bool both = sensedN(first_) >= touch_ && sensedN(record) >= touch_;
  const double before = held_s_;
  held_s_ = both ? held_s_ + dt : 0;
  if (before < kGrip_s && held_s_ >= kGrip_s)
    ++grips_[static_cast<std::size_t>(thing(record.commands))];
  now_N_ = both ? std::min(feltN(first_), feltN(record)) : 0;
  peak_ = std::max(peak_, now_N_);
}

}  // namespace palpa::task_squeeze
