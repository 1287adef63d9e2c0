#pragma once

#include <cstdint>

namespace palpa::bench {

struct TrackingBenchOptions {
  double distance = 0.5;   ///< m, from camera to board
  double speed = 0.2;      ///< m/s, the peak of a hand's motion there and back
  double horizon_ms = 50;  ///< from an exposure to when its pose is drawn
  int width = 1280, height = 720;
  double rate_Hz = 30;
  bool quick = false;  ///< a tenth of the pictures
  std::uint64_t seed = 1;
};

/// How true, still and quick the tracker is, on pictures of the virtual camera (lens, blur, noise,
/// 5 ms of exposure in motion) whose truth is known. One JSON object a line; simulated data.
void benchTracking(const TrackingBenchOptions& options);

}  // namespace palpa::bench
