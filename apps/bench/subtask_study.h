#pragma once

#include <string>

#include "apps/bench/floor_timing.h"

namespace palpa::bench {

/// A part of the task that is told by the probe's speed along the floor: on from v >= threshold,
/// off from v < (1 - hysteresis) threshold.
struct SpeedPart {
  haptics::TickConfig config;
  int part = 0;
  double threshold = 0;  ///< m/s
  double hysteresis = 0;
};
/// Throws Error where the task has no such part.
SpeedPart speedPart(const SearchFloor& floor, const std::string& name);

/// From when the true speed passes the figure at which the part goes on or off until the tick says
/// so, both ways; the speed goes between half and one and a half of the threshold with
/// `acceleration`, m/s^2; 0: at once. Positions in whole steps of `resolution`, m; 1 kHz; `runs`
/// phases: place, direction (every fourth along an axis) and time drawn.
struct Latency {
  double largest_ms = 0, median_ms = 0;
};
Latency subtaskLatency(const SpeedPart& part, double acceleration, double resolution, int runs);

/// How often a second the part goes on or off in steady straight motion at `share` of the
/// threshold: the worst of `runs` directions and phases, 2 s each once the speed's low-pass has
/// settled.
double switchesPerSecond(const SpeedPart& part, double share, double resolution, int runs);

}  // namespace palpa::bench
