#pragma once

#include "apps/assess/palpation/palpation_sample.h"

namespace palpa::assess {

/// One press or stroke: from touch to lift.
struct Press {
  double from_s = 0, to_s = 0;
  Vec3 p_P = Vec3::Zero();  ///< mean place while it was pressed, weighted by force
  double peak = 0;          ///< N
  double slid = 0;          ///< m, way along the surface
  bool palpating = false;   ///< several presses about one place: a closer look; else it is search
};

/// Touch: from `touch` newtons on; lifted for less than a tenth of a second it is the same press. A
/// press is palpation where at least two of its neighbours in time, within 5 s before or after it,
/// lie within 5 mm of it [chosen: a third of a fingertip's breadth; who searches moves on by more],
/// and search where they do not: who searches goes on.
std::vector<Press> pressesIn(PalpationSamples samples, double touch);

}  // namespace palpa::assess
