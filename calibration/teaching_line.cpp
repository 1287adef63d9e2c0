#include "calibration/teaching_line.h"

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

constexpr double kShortest = 0.005;  // m
const double kParallel = pinned::sin(2 * kDegree);

}  // namespace

Mat3 axesOf(const TeachingLine& line, double depth) {
  const Vec3 way_L = line.target_L - line.entry_L - depth * line.inward_L;
  const Vec3 along_L = way_L.normalized();
  const Vec3 across_L = line.inward_L - line.inward_L.dot(along_L) * along_L;
  if (!(way_L.norm() >= kShortest) || !(across_L.norm() >= kParallel))
    throw Error("the way from the entry to the vein is too short or runs along the skin's normal",
                "teaching line", "Check the landmarks entry_point and vein_target");
  Mat3 axes;
  axes << along_L, across_L.normalized(), along_L.cross(across_L.normalized());
  return axes;
}

}  // namespace palpa::calibration
