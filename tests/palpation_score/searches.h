#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "apps/assess/palpation/palpation_sample.h"

namespace palpa::assess {

/// Somebody who presses at places, one after the other: half a second each, up to `force`, then a
/// quarter of a second of lifting.
class Search {
 public:
  Search& press(double x, double y, double force) {
    for (int i = 0; i <= 50; ++i, t_ += 0.01)
      samples_.push_back({t_, Vec3(x, y, -0.003), force * std::sin(std::numbers::pi * i / 50)});
    for (int i = 0; i < 25; ++i, t_ += 0.01) samples_.push_back({t_, Vec3(x, y, 0.003), 0});
    return *this;
  }
  const std::vector<PalpationSample>& samples() const { return samples_; }
  double now() const { return t_; }

 private:
  std::vector<PalpationSample> samples_;
  double t_ = 0;
};

/// Up and down, strip beside strip, `step` apart, over an area of +-`half`.
inline Search inStrips(double half, double step, double force) {
  Search search;
  bool up = true;
  for (double x = -half; x <= half + 1e-9; x += step, up = !up) {
    for (double y = -half; y <= half + 1e-9; y += step) search.press(x, up ? y : -y, force);
  }
  return search;
}

}  // namespace palpa::assess
