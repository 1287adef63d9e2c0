#include "anatomy/parametric/feasibility.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/parametric/build.h"
#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {

TriangleMesh fromB(const TriangleMesh& mesh_B_mm, Side side) {
  TriangleMesh mesh = mesh_B_mm;
  for (Vec3& p : mesh.points) p = fromB(p, Side::left);
  return side == Side::left ? mesh : mirroredMesh(std::move(mesh));
}

namespace {

constexpr double kDepthError = 0.02;  // mm, of the fields
constexpr double kUnderBone =
    3.5;  // mm between the clavicle's lower border and the vein at the window

// l of the target, mm from the midline, by preference: behind the medial end of the clavicle.
constexpr double kMedially[] = {31, 33, 29,
                                35, 27, 25};  // nearer to the midline the jugular vein joins
// Depth of the target's centre, mm from the usual one, by preference.
constexpr double kDeeper[] = {0, 2, -2, 4, -4, 6, -6, 8, -8};

struct MeasuredRange {
  const char* what;
  double value, low, high;
  const char* unit;
};

void requireRanges(const PatientParameters& p) {
  for (const MeasuredRange& r :
       {MeasuredRange{"height", p.height, 1.40, 2.10, "m"},
        MeasuredRange{"bmi", p.bmi, 15, 50, "kg/m2"},
        MeasuredRange{"vein_depth", 1e3 * p.vein_depth, 4.9, 35.1, "mm"},
        MeasuredRange{"vein_diameter", 1e3 * p.vein_diameter, 3.9, 14.1, "mm"},
        MeasuredRange{"pleura_distance", 1e3 * p.pleura_distance, 1, 11, "mm"},
        MeasuredRange{"clavicle_length", 1e3 * p.clavicle_length, 120, 178, "mm"},
        MeasuredRange{"clavicle_thickness", 1e3 * p.clavicle_thickness, 9, 15, "mm"},
        MeasuredRange{"layers.skin", 1e3 * p.layers.skin, 1, 4, "mm"},
        MeasuredRange{"layers.fat", 1e3 * p.layers.fat, 1, 20, "mm"},
        MeasuredRange{"layers.muscle", 1e3 * p.layers.muscle, 2.5, 16, "mm"}})
    if (!(r.value >= r.low && r.value <= r.high))
      throw Error(std::string(r.what) + " is " + std::to_string(r.value) + " " + r.unit +
                      ", outside " + std::to_string(r.low) + " to " + std::to_string(r.high) + " " +
                      r.unit,
                  "parametric patient", "Give a value inside the range");
}

// In a lean person with a short clavicle a wide vein keeps the line farther from the bone: better
// that than no line.
TaughtLine findLine(const TaughtLineSearch& search, double usual_depth, double radius) {
  const TaughtLimits usual;
  TaughtLimits wide;
  wide.highest_clearance = std::max(usual.highest_clearance, radius + usual.vein_to_bone + 0.2);
  std::optional<Error> first;
  for (const TaughtLimits& limits : {usual, wide})
    for (const double deeper : kDeeper)
      for (const double l : kMedially) {
        try {
          return search.find(l, usual_depth + deeper, radius, limits);
        } catch (const Error& error) {
          if (!first) first = error;
        }
      }
  throw *first;
}

// Depth at which the line from the skin inward meets the vein's front wall: sphere tracing.
double frontWallDepth(const Vessels& vessels, const Vec3& skin, const Vec3& inward) {
  double depth = 0;
  for (int i = 0; i < 200; ++i) {
    const double distance = vessels.veinField(skin + depth * inward);
    depth += distance;
    if (std::abs(distance) < 1e-4) break;
  }
  return depth;
}

}  // namespace

Build buildOf(const PatientParameters& p) {
  constexpr double kClavicle = 0.1494, kHeight = 1.70, kPlainBmi = 23;
  return {p.clavicle_length / kClavicle, p.height / kHeight,
          std::clamp(1.0 * (p.bmi - kPlainBmi), -5.0, 24.0), p.sex == Sex::female, p.extent};
}

Solution solve(const PatientParameters& p) {
  requireRanges(p);
  const double depth = 1e3 * p.vein_depth, radius = 500 * p.vein_diameter;
  const Build build = buildOf(p);
  const Clavicle clavicle = makeClavicle(1e3 * p.clavicle_length, 1e3 * p.clavicle_thickness);
  const BodySurface skin(clavicle, build, p.layers, softAtWindow(depth));
  const double layers = 1e3 * (p.layers.skin + p.layers.fat + p.layers.muscle);
  const TaughtLine line =
      findLine(TaughtLineSearch(skin, clavicle), 20 + 0.85 * (layers - 16) + radius, radius);

  const double l = clavicle.middle.x(), z = clavicle.lowerBorder(0.5) - kUnderBone - radius;
  const Vec3 over(l, skin.front(l, z, true), z), inward = -skin.frontNormal(l, z);
  double aim = depth + 1.12 * radius;  // the vein is wider there
  for (int i = 0; i < 8; ++i) {
    const Vec3 window = over + aim * inward;
    Vessels vessels = makeVessels(line.target, window, radius, p.side);
    const double error = depth - frontWallDepth(vessels, over, inward);
    if (std::abs(error) < kDepthError)
      return {build, clavicle, skin, line, window, over, std::move(vessels)};
    aim += error;
  }
  throw Error("the vein cannot be brought to its depth", "parametric patient",
              "Choose a vein depth nearer to its mean");
}

}  // namespace palpa::anatomy
