#include "anatomy/parametric/feasibility.h"

#include <cmath>
#include <optional>

#include "anatomy/geometry/error.h"

namespace palpa::anatomy {
namespace {

constexpr double kDepthError = 0.02;  // mm, of the fields

// l of the target, mm from the midline, by preference: behind the medial end of the clavicle.
constexpr double kMedially[] = {31, 32, 30, 33, 29, 34, 28, 35, 27, 36, 26, 37, 25, 38, 24};

struct Range {
  const char* what;
  double value_mm, low_mm, high_mm;
};

void requireRanges(const PatientParameters& p) {
  for (const Range& r : {Range{"vein_depth", 1e3 * p.vein_depth, 14, 28},
                         Range{"vein_diameter", 1e3 * p.vein_diameter, 5, 13},
                         Range{"pleura_distance", 1e3 * p.pleura_distance, 2, 11},
                         Range{"clavicle_length", 1e3 * p.clavicle_length, 120, 172},
                         Range{"clavicle_thickness", 1e3 * p.clavicle_thickness, 9, 15},
                         Range{"layers.skin", 1e3 * p.layers.skin, 1, 4},
                         Range{"layers.fat", 1e3 * p.layers.fat, 2, 12},
                         Range{"layers.muscle", 1e3 * p.layers.muscle, 4, 14}})
    if (!(r.value_mm >= r.low_mm && r.value_mm <= r.high_mm))
      throw Error(std::string(r.what) + " is " + std::to_string(r.value_mm) + " mm, outside " +
                      std::to_string(r.low_mm) + " to " + std::to_string(r.high_mm) + " mm",
                  "parametric patient", "Give a value inside the range");
}

// Depth at which the line from the skin to the target meets the vein's front wall: sphere tracing.
double frontWallDepth(const Vessels& vessels, const TaughtLine& line) {
  const Vec3 inward = (line.target - line.target_skin).normalized();
  double depth = 0;
  for (int i = 0; i < 200; ++i) {
    const double distance = vessels.veinField(line.target_skin + depth * inward);
    depth += distance;
    if (std::abs(distance) < 1e-4) break;
  }
  return depth;
}

}  // namespace

Solution solve(const PatientParameters& parameters) {
  requireRanges(parameters);
  const double depth = 1e3 * parameters.vein_depth, radius = 500 * parameters.vein_diameter;
  const Clavicle clavicle =
      makeClavicle(1e3 * parameters.clavicle_length, 1e3 * parameters.clavicle_thickness);
  const BodySurface skin(clavicle, parameters.layers);
  const TaughtLineSearch search(skin, clavicle);
  std::optional<Error> first;
  for (const double l : kMedially) {
    try {
      double aim = depth + radius;
      for (int i = 0; i < 6; ++i) {
        const TaughtLine line = search.find(l, aim, radius);
        Vessels vessels = makeVessels(line.target, radius);
        const double error = depth - frontWallDepth(vessels, line);
        if (std::abs(error) < kDepthError) return {clavicle, skin, line, std::move(vessels)};
        aim += error;
      }
    } catch (const Error& error) {
      if (!first) first = error;
    }
  }
  if (first) throw *first;
  throw Error("the vein cannot be brought to its depth", "parametric patient",
              "Choose a vein depth nearer to its mean");
}

}  // namespace palpa::anatomy
