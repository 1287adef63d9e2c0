#pragma once

#include <string>
#include <vector>

namespace palpa::report {

/// A stretch of numbers shown on a stretch of the picture; `from_px` may be the larger one.
struct Axis {
  double from = 0, to = 1;        ///< data
  double from_px = 0, to_px = 1;  ///< picture
  double at(double value) const {
    return from_px + (value - from) / (to - from) * (to_px - from_px);
  }
};

struct Ticks {
  std::vector<double> values;
  int decimals = 0;  ///< enough to tell neighbours apart
  std::string label(double value) const;
};

/// Round values in [from, to]: multiples of 1, 2 or 5 times a power of ten, at most `most` of them
/// (`most` >= 2), as many as fit. Zero is among them if it lies within.
Ticks niceTicks(double from, double to, int most);

/// The smallest round number not below `value` (> 0): where an axis that starts at zero may end.
double niceCeiling(double value);

}  // namespace palpa::report
