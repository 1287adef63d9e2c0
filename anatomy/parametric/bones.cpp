#include "anatomy/parametric/bones.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "anatomy/shapes/mesh_tools.h"
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
  std::vector<TubeStation> stations;
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

namespace {

constexpr int kAlongRib = 96, kAroundRib = 16;
constexpr double kJointGap = 0.7;  // mm between bone and cartilage

// Middle line of a rib from the sternum to the vertebra, mm; the cartilage ends at `joint`.
struct Course {
  double joint;         // as a fraction of the course
  double broad, thick;  // half-axes, mm
  std::size_t count;    // of points
  double points[9][3];
};

// Ribs 1 to 7.
constexpr Course kCourses[] = {
    {0.20,
     6.5,
     3.0,
     8,
     {{25.5, 12, -19},
      {40, 21, -20},
      {52, 32, -17.5},
      {59.5, 47, -10},
      {61, 62, -1},
      {55, 76, 9},
      {42, 86, 17},
      {26, 88, 22}}},
    {0.17,
     6.5,
     3.0,
     9,
     {{19, 2.2, -50},
      {40, 6.5, -51},
      {64, 15, -50},
      {84, 31, -45},
      {94, 54, -33},
      {92, 78, -18},
      {78, 98, -5},
      {56, 107, 2},
      {28, 96, 6}}},
    {0.17,
     6.6,
     3.1,
     9,
     {{21, -2.2, -82},
      {44, 0.5, -86},
      {72, 9, -87},
      {97, 28, -83},
      {110, 54, -71},
      {109, 82, -55},
      {95, 106, -39},
      {67, 119, -24},
      {28, 106, -16}}},
    {0.18,
     6.8,
     3.2,
     9,
     {{21, -6, -106},
      {46, -6, -114},
      {78, 4, -119},
      {106, 24, -117},
      {121, 54, -106},
      {120, 86, -89},
      {105, 114, -71},
      {74, 129, -53},
      {28, 115, -40}}},
    {0.21,
     7.0,
     3.3,
     9,
     {{21.5, -8.5, -126},
      {46, -10, -139},
      {80, 0, -148},
      {110, 22, -148},
      {127, 54, -138},
      {127, 90, -121},
      {111, 121, -102},
      {78, 137, -83},
      {28, 122, -66}}},
    {0.26,
     7.0,
     3.3,
     9,
     {{20.5, -10, -141},
      {42, -13, -155.5},
      {74, -6, -172},
      {106, 14, -177},
      {128, 50, -169},
      {130, 92, -152},
      {114, 126, -132},
      {80, 143, -112},
      {28, 128, -94}}},
    {0.31,
     7.0,
     3.3,
     9,
     {{17.5, -10, -154},
      {36, -14, -174.5},
      {66, -8, -192},
      {100, 10, -202},
      {126, 48, -198},
      {131, 92, -182},
      {116, 129, -162},
      {82, 146, -142},
      {28, 132, -122}}},
};

// The bar's broad side stands upright at the flank and leans with the chest wall in front; the
// first lies flat.
Vec3 broadSide(std::size_t rib) {
  if (rib == 0) return {0.35, -0.55, 0.1};
  return rib == 1 ? Vec3(0.15, -0.25, 1) : Vec3(0.05, -0.1, 1);
}

TriangleMesh part(const std::vector<Section>& all, std::size_t begin, std::size_t end,
                  double bulge) {
  return sweep({all.begin() + static_cast<std::ptrdiff_t>(begin),
                all.begin() + static_cast<std::ptrdiff_t>(end)},
               kAroundRib, bulge);
}

Rib makeRib(const Course& course, const std::vector<Vec3>& points, const Vec3& broad) {
  const Curve curve(points);
  std::vector<Section> sections = sectionsAlong(curve.sample(kAlongRib), broad);
  // Round cartilage at the sternum, a knob at its joint with the bone, then a flat bar with a neck
  // and a head.
  const double j = course.joint;
  const Spline broadness{{0, 0.80},    {0.6 * j, 0.88}, {j, 1.10},    {j + 0.08, 1},
                         {0.55, 1.04}, {0.84, 0.92},    {0.93, 0.78}, {1, 0.9}};
  const Spline thickness{{0, 1.40}, {0.6 * j, 1.30}, {j, 1.35},   {j + 0.1, 1.02},
                         {0.55, 1}, {0.80, 1.2},     {0.93, 1.1}, {1, 1.5}};
  std::vector<TubeStation> stations;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(sections.size() - 1);
    sections[i].half_up = course.broad * broadness(u);
    sections[i].half_side = course.thick * thickness(u);
    if (i % 3 == 0 || i + 1 == sections.size())
      stations.push_back(
          {sections[i].centre, std::max(sections[i].half_up, sections[i].half_side)});
  }
  const auto joint = static_cast<std::size_t>(std::lround(j * (kAlongRib - 1)));
  constexpr double kFlat = 0.12;  // bulge of the ends at the joint
  const auto retreat = [&](std::size_t i) {
    return static_cast<std::size_t>(std::ceil((2 * kFlat * course.broad + kJointGap) /
                                              (curve.length() / (kAlongRib - 1)))) +
           i;
  };
  return {TubeField(std::move(stations)), part(sections, retreat(joint), sections.size(), kFlat),
          part(sections, 0, joint + 1, kFlat)};
}

}  // namespace

std::vector<Rib> makeRibs(const Build& build, double vein_radius_mm) {
  const double drop = 1.4 * std::max(0.0, vein_radius_mm - 4.5);
  std::vector<Rib> ribs;
  const std::size_t count = build.bust() ? 4 : std::size(kCourses);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < kCourses[i].count; ++k) {
      const Vec3 p(kCourses[i].points[k]);
      points.push_back(i == 0 ? p : build.place(p));
    }
    if (i == 0)
      for (const std::size_t low : {1, 2, 3}) points[low].z() -= drop;
    ribs.push_back(makeRib(kCourses[i], points, broadSide(i)));
  }
  return ribs;
}

}  // namespace palpa::anatomy
