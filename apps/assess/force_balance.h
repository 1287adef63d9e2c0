#pragma once

#include <cstddef>
#include <vector>

#include "haptics/flight_record.h"

/// Do the recorded forces on a tool add up? Newton's second law as a check of everything that
/// measures them: signs, frames, scales, tool weight.
namespace palpa::assess {

struct ForceBalance {
  std::size_t samples = 0;
  double largest_N = 0, rms_N = 0;  ///< of the residual
  double object_N = 0;              ///< largest reaction that was sensed, smoothed alike
  double delay_s = 0;               ///< of the sensed reaction, as found
};

/// At every tick with all of it recorded (an instrumented device, a sensor that is believed), along
/// D's axes:
///     | S (f_hand + f_device + f_sensed) - m (p(t + T) - 2 p(t) + p(t - T)) / T^2 |,   T = 20 ms
/// with S the triangular mean of base 2 T, under which the second difference over T is exactly the
/// mean acceleration; a balanced device needs no weight of its own, and the sensor's word is
/// cleared of the tool's. The sensed reaction may come through a low-pass: it is taken as much
/// later as its own position record p_DK lags behind the tool's. `mass`: the device's apparent one,
/// kg; ticks of one session in order; a gap of time begins anew.
ForceBalance balanceOf(const std::vector<haptics::FlightRecord>& ticks, double mass);

}  // namespace palpa::assess
