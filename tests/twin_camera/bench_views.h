#pragma once

#include <vector>

#include "anatomy/base/quantile.h"
#include "apps/twin/virtual_camera.h"
#include "apps/twin/virtual_camera_picture.h"
#include "tests/support/camera_views.h"

/// Where the bench's camera stands in these tests.
namespace palpa::twin {

using test::lookAt;
using test::rad;
inline calibration::CameraModel benchLens() { return test::webcam(); }

/// View `i` of a seeded series: tilt 30 to 45 degrees, any side, target within 10 mm of the centre.
inline Pose benchView(std::uint64_t i, double distance) {
  const auto draw = [&](std::uint64_t n) { return picture::uniform(99, 16 * i + n); };
  return lookAt({0.02 * draw(0) - 0.01, 0.02 * draw(1) - 0.01, 0}, distance, rad(30 + 15 * draw(2)),
                rad(360 * draw(3)), rad(30 * draw(4) - 15));
}

}  // namespace palpa::twin
