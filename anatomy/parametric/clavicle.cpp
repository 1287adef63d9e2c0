#include "anatomy/parametric/clavicle.h"

#include <cmath>
#include <numbers>

#include "anatomy/shapes/spline.h"

namespace palpa::anatomy {
namespace {

constexpr int kSections = 97;  // one more than a multiple of three: both thirds are sections
constexpr double kNominalChord = 149.4;
constexpr double kMedialRadius = 66, kLateralRadius = 34;
constexpr double kMedialBegin = 0.04, kMedialEnd = 0.58, kLateralBegin = 0.60, kLateralEnd = 0.97;

const Vec3 kSternalCentre(19, 9.8, 0);
const Vec3 kChordDirection = Vec3(0.91, 0.36, 0.20).normalized();

double bump(double u, double begin, double end) {
  if (u <= begin || u >= end) return 0;
  return std::sin(std::numbers::pi * (u - begin) / (end - begin));
}

// Signed curvature at fraction u of the arc, 1/mm for the nominal length; positive: convex forward.
double curvature(double u) {
  return bump(u, kMedialBegin, kMedialEnd) / kMedialRadius -
         bump(u, kLateralBegin, kLateralEnd) / kLateralRadius;
}

// The S in its own plane: x along the chord from 0 to 1, y forward.
std::vector<Eigen::Vector2d> planeCurve() {
  constexpr int kSteps = 960;
  std::vector<Eigen::Vector2d> points{Eigen::Vector2d::Zero()};
  double heading = 0;
  for (int i = 0; i < kSteps; ++i) {
    heading -= curvature((i + 0.5) / kSteps) * kNominalChord / kSteps;
    points.push_back(points.back() +
                     Eigen::Vector2d(std::cos(heading), std::sin(heading)) / kSteps);
  }
  const Eigen::Vector2d chord = points.back();
  const Eigen::Rotation2Dd turn(-std::atan2(chord.y(), chord.x()));
  std::vector<Eigen::Vector2d> taken;
  for (int i = 0; i < kSections; ++i)
    taken.push_back(turn * points[i * kSteps / (kSections - 1)] / chord.norm());
  return taken;
}

// Half-axes as multiples of the midshaft's half thickness.
const Spline& halfUp() {
  static const Spline s{{0, 1.60},  {0.035, 1.52}, {0.10, 1.12}, {0.17, 1.0}, {0.3, 0.99},
                        {0.5, 1.0}, {0.7, 0.92},   {0.85, 0.84}, {1, 0.72}};
  return s;
}
const Spline& halfSide() {
  static const Spline s{{0, 1.45},  {0.035, 1.35}, {0.10, 1.02}, {0.17, 0.96}, {0.3, 0.98},
                        {0.5, 1.0}, {0.7, 1.25},   {0.85, 1.65}, {1, 1.55}};
  return s;
}

}  // namespace

double Clavicle::lowerBorder(double fraction) const {
  const Section& s = sections[static_cast<std::size_t>(std::lround(fraction * (kSections - 1)))];
  const Vec3 side = s.tangent.cross(s.up);
  return s.centre.z() - std::hypot(s.half_up * s.up.z(), s.half_side * side.z());
}

Clavicle makeClavicle(double chord_mm, double thickness_mm) {
  constexpr double kBulge = 0.35;  // the ends are blunt
  const double caps =
      kBulge * thickness_mm / 4 * (halfUp()(0) + halfSide()(0) + halfUp()(1) + halfSide()(1));
  const double centre_chord = chord_mm - 0.93 * caps;  // 0.93: the ends point off the chord
  const Vec3 along = kChordDirection;
  const Vec3 forward = (-Vec3::UnitY() + along * along.y()).normalized();
  std::vector<Vec3> centres;
  for (const Eigen::Vector2d& q : planeCurve())
    centres.push_back(kSternalCentre + centre_chord * (q.x() * along + q.y() * forward));

  std::vector<Section> sections = sectionsAlong(centres, Vec3::UnitZ());
  std::vector<TubeField::Station> stations;
  for (int i = 0; i < kSections; ++i) {
    const double u = double(i) / (kSections - 1);
    sections[i].half_up = thickness_mm / 2 * halfUp()(u);
    sections[i].half_side = thickness_mm / 2 * halfSide()(u);
    if (i % 3 == 0)
      stations.push_back({sections[i].centre, (sections[i].half_up + sections[i].half_side) / 2});
  }
  TriangleMesh mesh = sweep(sections, 28, kBulge);

  const auto end = [&](const Section& s, double sign) {
    return Vec3(s.centre + sign * kBulge * (s.half_up + s.half_side) / 2 * s.tangent);
  };
  const Section& first = sections.front();
  Vec3 back = first.tangent.cross(first.up);
  if (back.y() < 0) back = -back;
  const Vec3 corner =
      first.centre + (first.half_up * first.up + first.half_side * back) / std::numbers::sqrt2;
  const Vec3 sternal = end(first, -1), acromial = end(sections.back(), 1);
  const Vec3 medial = sections[(kSections - 1) / 3].centre;
  const Vec3 middle = sections[(kSections - 1) / 2].centre;
  const Vec3 lateral = sections[2 * (kSections - 1) / 3].centre;
  return {std::move(sections),
          std::move(mesh),
          TubeField(std::move(stations)),
          sternal,
          corner,
          acromial,
          medial,
          middle,
          lateral};
}

}  // namespace palpa::anatomy
