#pragma once

#include "anatomy/local_geometry_builder.h"
#include "apps/bench/bare_loop.h"
#include "apps/bench/scene_load.h"
#include "apps/bench/stroke.h"

namespace palpa::bench {

/// Everything that runs beside the loop, the same whichever loop is measured: the hand's device at
/// 1 kHz, geometry queries at 60 Hz on the torso, the records taken off at 10 Hz, the picture at 30
/// Hz where there is one.
struct LoopSurroundings {
  StrokeSettings stroke;
  const anatomy::LocalGeometryBuilder& builder;
  SceneLoad* scene = nullptr;  ///< null: not drawn
  std::int64_t period_ns = 1'000'000;
  int cpu = -1;
};

struct OurTimes {
  LoopTimes times;
  runtime::Spread cost;
  std::uint64_t contacts = 0;  ///< ticks with a contact force: the step did its work
};

/// HapticActivity (probe) on the real executive for `length_ns`.
OurTimes runOurSegment(const LoopSurroundings& around, std::int64_t length_ns);
/// The bare timer loop, with the same beside it.
LoopTimes runBareSegment(const LoopSurroundings& around, std::int64_t length_ns);

}  // namespace palpa::bench
