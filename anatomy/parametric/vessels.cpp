#include "anatomy/parametric/vessels.h"

#include <algorithm>
#include <cmath>

#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/spline.h"

namespace palpa::anatomy {
namespace {

// A point of a vessel for the template's target and window, and how much it moves with either.
struct VesselPoint {
  Vec3 p;
  double with_target, with_window;
  double radius;  // mm, or as a multiple of the vein's
};

const Vec3 kTemplateTarget(33, 22.7, 1.5), kTemplateWindow(84, 37.5, -8.5);

constexpr double kMedialGive =
    0.6;  // what lies medial of a target near the midline has the airway beside it

struct Shifts {
  Vec3 target, window;
};

TubeField through(const std::vector<VesselPoint>& guides, const Shifts& shifts, double radius_unit,
                  double sign = 1) {
  std::vector<Vec3> points;
  for (const VesselPoint& g : guides) {
    Vec3 with_target = g.with_target * shifts.target;
    if (g.p.x() < kTemplateTarget.x() - 3) with_target.x() *= with_target.x() < 0 ? kMedialGive : 1;
    const Vec3 p = g.p + with_target + g.with_window * shifts.window;
    points.push_back({sign * p.x(), p.y(), p.z()});
  }
  const Curve curve(points);
  std::vector<Spline::Knot> knots;
  double s = 0;
  for (std::size_t i = 0; i < guides.size(); ++i) {
    if (i > 0) s += (points[i] - points[i - 1]).norm();
    knots.push_back({s, radius_unit * guides[i].radius});
  }
  const Spline radius(knots);
  const int stations = std::max(12, static_cast<int>(curve.length() / 2.4));
  std::vector<TubeStation> tube;
  for (int i = 0; i < stations; ++i) {
    const double at = curve.length() * i / (stations - 1);
    tube.push_back({curve(at), radius(at)});
  }
  return TubeField(std::move(tube));
}

double joined(const std::vector<TubeField>& tubes, const Vec3& p, double fillet) {
  double f = tubes.front()(p);
  for (std::size_t i = 1; i < tubes.size(); ++i) f = addTube(f, tubes[i], p, 0, fillet);
  return f;
}

TriangleMesh tubesMesh(const Field& field, const std::vector<TubeField>& tubes, double cell) {
  Eigen::AlignedBox3d box;
  for (const TubeField& tube : tubes)
    for (const auto& station : tube.stations()) {
      box.extend(Vec3(station.p.array() - station.radius - 2 * cell));
      box.extend(Vec3(station.p.array() + station.radius + 2 * cell));
    }
  return surfaceNets(field, box, cell);
}

// Pressed flat where less than `gap` would be left: hardly rounded, so that nothing changes where
// there is room.
double besideBone(double f, const Field& bones, const Vec3& p, double gap) {
  constexpr double kRounding = 0.4;
  return f > 8 ? f : smoothMax(f, gap - bones(p), kRounding);
}

// From the axilla to the confluence, then to the superior vena cava: short and steep on the
// patient's right, long and across the midline on his left. `unit`: radius at the target.
TubeField veinOf(bool right, double unit, const Shifts& shifts, double sign) {
  const double even = (1 + 4.5 / unit) / 2;  // the brachiocephalic veins differ less between people
  std::vector<VesselPoint> guides{{{122, 54, -26}, 0, 0.5, 1.22}, {{104, 45, -16}, 0, 0.9, 1.2},
                                  {kTemplateWindow, 0, 1, 1.12},  {{64, 31.5, -3}, 0.6, 0.4, 1.03},
                                  {{48, 26.5, 0}, 1, 0, 1},       {kTemplateTarget, 1, 0, 1},
                                  {{24, 26.5, -0.5}, 1, 0, 1.06}};
  const std::vector<VesselPoint> to_cava =
      right ? std::vector<VesselPoint>{{{19, 29.5, -9}, 0.9, 0, 1.3 * even},
                                       {{18.5, 33, -24}, 0.5, 0, 1.5 * even},
                                       {{20, 38, -42}, 0.1, 0, 1.7 * even}}
            : std::vector<VesselPoint>{{{15, 28, -8}, 1, 0, 1.25 * even},
                                       {{4, 29, -17}, 0.6, 0, 1.4 * even},
                                       {{-9, 32, -28}, 0.2, 0, 1.45 * even},
                                       {{-20, 38, -44}, 0.1, 0, 1.5 * even}};
  guides.insert(guides.end(), to_cava.begin(), to_cava.end());
  return through(guides, shifts, unit, sign);
}

TubeField jugularOf(double unit, const Shifts& shifts, double sign) {
  return through({{{19, 28.6, -5}, 1, 0, 1.1},
                  {{21.5, 30, 8}, 0.9, 0, 1.3},
                  {{27, 33.5, 30}, 0.5, 0, 1.3},
                  {{33, 38, 58}, 0.1, 0, 1.2},
                  {{36, 44, 92}, 0, 0, 1.1}},
                 shifts, std::sqrt(4.5 * unit), sign);
}

// Laterally behind and above the vein's axis (4 mm of tissue between the walls), medially over the
// lung's dome and behind the jugular vein to where the carotid leaves.
TubeField subclavianArtery(bool right, double unit, const Shifts& shifts, double sign) {
  const double gap = unit + 4 + 4;
  const Vec3 offset = gap * Vec3(-1, 9.3, 8.6).normalized();
  const double wide = std::max(0.0, 1.5 * (unit - 4.5));  // behind wide veins
  std::vector<VesselPoint> guides{{Vec3(123, 54, -26) + 1.08 * offset, 0, 0.5, 3.4},
                                  {Vec3(104, 45, -16) + 1.08 * offset, 0, 0.9, 3.5},
                                  {Vec3(84, 37.5, -8.5) + 1.08 * offset, 0, 1, 3.7},
                                  {Vec3(64, 31.5, -3) + 1.1 * offset, 0.6, 0.4, 3.9},
                                  {Vec3(48, 27, 0) + 1.2 * offset, 1, 0, 4.0},
                                  {{34, 42 + wide, 13}, 1, 0, 4.1}};
  const std::vector<VesselPoint> to_arch =
      right ? std::vector<VesselPoint>{{{22, 46 + wide, 8}, 0.8, 0, 4.4},
                                       {{16, 47 + wide, -4}, 0.4, 0, 5.2}}
            : std::vector<VesselPoint>{{{24, 49 + wide, 9}, 0.8, 0, 4.5},
                                       {{21, 56 + wide, -10}, 0.4, 0, 5.0},
                                       {{20, 62, -34}, 0.1, 0, 5.4},
                                       {{19, 64, -50}, 0, 0, 5.8}};
  guides.insert(guides.end(), to_arch.begin(), to_arch.end());
  return through(guides, shifts, 1, sign);
}

}  // namespace

double Vessels::veinField(const Vec3& p) const { return joined(veins, p, 5); }
double Vessels::veinsAtLeast(const Vec3& p) const {
  double least = veins.front().atLeast(p);
  for (const TubeField& tube : veins) least = std::min(least, tube.atLeast(p));
  return least - 3;  // the fillets reach a little farther
}

double Vessels::arteryField(const Vec3& p) const { return joined(arteries, p, 4); }

TriangleMesh Vessels::veinMesh(const Field& bones) const {
  return tubesMesh([&](const Vec3& p) { return besideBone(veinField(p), bones, p, 0.7); }, veins,
                   std::clamp(0.5 * vein_radius, 1.1, 1.6));
}

TriangleMesh Vessels::arteryMesh(const Field& bones, double lowest) const {
  // Where a wide vein lies against an artery, the artery gives way.
  const auto field = [&](const Vec3& p) {
    const double f = smoothMax(arteryField(p), lowest - p.z(), 4);
    return f > 8 ? f : besideBone(smoothMax(f, 1.0 - veinField(p), 3), bones, p, 0.8);
  };
  return tubesMesh(field, arteries, 2.0);
}

Vessels makeVessels(const Vec3& target, const Vec3& window, double vein_radius_mm, Side side) {
  const Shifts shifts{target - kTemplateTarget, window - kTemplateWindow};
  const Shifts none{Vec3::Zero(), Vec3::Zero()};
  Vessels v;
  v.handed = side == Side::right ? 1 : -1;
  v.vein_radius = vein_radius_mm;
  const double wide = std::max(0.0, 1.5 * (vein_radius_mm - 4.5)), r = v.handed;
  for (const double sign : {1.0, -1.0}) {
    const bool right = sign == v.handed;
    v.veins.push_back(veinOf(right, vein_radius_mm, shifts, sign));
    v.veins.push_back(jugularOf(vein_radius_mm, shifts, sign));
    v.arteries.push_back(subclavianArtery(right, vein_radius_mm, shifts, sign));
  }
  v.veins.push_back(
      through({{{20, 38, -42}, 0, 0, 8.2}, {{23, 43, -64}, 0, 0, 9.2}, {{24, 50, -100}, 0, 0, 9.6}},
              none, 1, r));
  // Ascending aorta, arch, descending aorta; brachiocephalic trunk; the two common carotids.
  v.arteries.push_back(through({{{-2, 46, -112}, 0, 0, 13.5},
                                {{0, 46, -80}, 0, 0, 13.2},
                                {{-6, 50, -60}, 0, 0, 12.6},
                                {{-20, 58, -53}, 0, 0, 12},
                                {{-27, 76, -62}, 0, 0, 11.6},
                                {{-30, 92, -86}, 0, 0, 11.4},
                                {{-28, 102, -130}, 0, 0, 11},
                                {{-24, 106, -165}, 0, 0, 10.6}},
                               none, 1, r));
  v.arteries.push_back(through({{{-3, 50, -55}, 0, 0, 6.6},
                                {{8, 47.5 + wide, -32}, 0, 0, 6.0},
                                {{15.5, 47 + wide, -14}, 0, 0, 5.6},
                                {{16, 47 + wide, -4}, 0, 0, 5.4}},
                               none, 1, r));
  v.arteries.push_back(through({{{16, 47 + wide, -4}, 0, 0, 3.8},
                                {{20, 51 + wide, 20}, 0, 0, 3.5},
                                {{25, 52, 58}, 0, 0, 3.4},
                                {{29, 54, 92}, 0, 0, 3.4}},
                               none, 1, r));
  v.arteries.push_back(through({{{-14, 56, -54}, 0, 0, 4.4},
                                {{-17, 54.5 + wide, -26}, 0, 0, 4.0},
                                {{-18, 53 + wide, 4}, 0, 0, 3.7},
                                {{-22, 52 + wide, 26}, 0, 0, 3.5},
                                {{-26, 52, 58}, 0, 0, 3.4},
                                {{-29, 54, 92}, 0, 0, 3.4}},
                               none, 1, r));
  return v;
}

}  // namespace palpa::anatomy
