#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/bench/timing.h"
#include "apps/task_search/floors.h"

namespace palpa::bench {

/// An augmented episode of the shipped search task, its floor made as a session makes it, and the
/// tick's configuration on the shipped station.
struct SearchFloor {
  task_search::SearchSettings task;
  haptics::TickConfig config;
  std::unique_ptr<task_search::MadeFloor> made;
  double made_in_s = 0;  ///< surface, height map, table of rises, valleys
};
/// `map_px` of the height map; 0: the task's own.
SearchFloor searchFloor(int map_px);

/// One question of the tick's to the floor, by itself: us, the median of blocks of 1000 at places
/// drawn evenly, none asked for twice.
struct LookUp {
  std::string name;    ///< of the metric
  std::string places;  ///< where it was asked
  double median_us = 0;
};
std::vector<LookUp> timeLookUps(const SearchFloor& floor, int blocks);

/// The whole tick, reading to command, while the probe goes round through all three elements at
/// speeds on both sides of every threshold:
///   r = R + 35 U sin(2 pi 1.7 Hz t),   angle = 2 pi 0.8 Hz t
/// so deep under the smooth floor that the degraded floor gives `press_N`. As fast as it goes, 16
/// at a time.
struct FloorTickTiming {
  QueryTiming augmented,
      plain;          ///< every augmentation of the task; the same floor in a session that has none
  Ratio ratio;        ///< augmented over plain, A B B A
  double pushed = 0;  ///< share of the ticks in which some augmentation gave force
  int pushing = 0,
      parts = 0;  ///< how many augmentations ever gave force, parts of the task were ever on
  double press_N = 0;
};
FloorTickTiming timeFloorTick(const SearchFloor& floor, int ticks, int blocks);

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
