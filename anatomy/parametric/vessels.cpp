#include "anatomy/parametric/vessels.h"

#include <algorithm>
#include <cmath>

#include "anatomy/shapes/spline.h"
#include "anatomy/shapes/surface_nets.h"

namespace palpa::anatomy {
namespace {

// A point of a vessel for the template's target; `follows`: how much it moves with the target.
struct Guide {
  Vec3 p;
  double follows;
  double radius;  // as a multiple of the vein's at the target, or mm for the artery
};

const Vec3 kTemplateTarget(33, 22.7, 1.5);

TubeField through(const std::vector<Guide>& guides, const Vec3& shift, double radius_unit,
                  int stations) {
  std::vector<Vec3> points;
  for (const Guide& g : guides) points.push_back(g.p + g.follows * shift);
  const Curve curve(points);
  std::vector<Spline::Knot> knots;
  double s = 0;
  for (std::size_t i = 0; i < guides.size(); ++i) {
    if (i > 0) s += (points[i] - points[i - 1]).norm();
    knots.push_back({s, radius_unit * guides[i].radius});
  }
  const Spline radius(knots);
  std::vector<TubeField::Station> tube;
  for (int i = 0; i < stations; ++i) {
    const double at = curve.length() * i / (stations - 1);
    tube.push_back({curve(at), radius(at)});
  }
  return TubeField(std::move(tube));
}

TriangleMesh tubeMesh(const Field& field, const TubeField& a, const TubeField& b) {
  Eigen::AlignedBox3d box;
  for (const TubeField* tube : {&a, &b})
    for (const auto& station : tube->stations()) {
      box.extend(Vec3(station.p.array() - station.radius - 3));
      box.extend(Vec3(station.p.array() + station.radius + 3));
    }
  return surfaceNets(field, box, 1.35);
}

}  // namespace

double Vessels::veinField(const Vec3& p) const { return smoothMin(vein(p), jugular(p), 5); }

TriangleMesh Vessels::veinMesh() const {
  return tubeMesh([this](const Vec3& p) { return veinField(p); }, vein, jugular);
}

TriangleMesh Vessels::arteryMesh() const { return tubeMesh(std::cref(artery), artery, artery); }

Vessels makeVessels(const Vec3& vein_target, double vein_radius_mm) {
  const Vec3 shift = vein_target - kTemplateTarget;
  // The brachiocephalic vein differs less between people than the subclavian does.
  const double even = (1 + 4.5 / vein_radius_mm) / 2;
  const std::vector<Guide> vein{{{122, 54, -26}, 0.1, 1.22},
                                {{104, 45, -16}, 0.2, 1.2},
                                {{84, 37.5, -8.5}, 0.5, 1.12},
                                {{64, 31.5, -3}, 0.9, 1.03},
                                {{48, 26.5, 0}, 1, 1},
                                {kTemplateTarget, 1, 1},
                                {{24, 26.5, -0.5}, 1, 1.06},
                                {{15.5, 30, -9}, 1, 1.3 * even},
                                {{9, 33, -24}, 0.7, 1.45 * even},
                                {{4, 35, -42}, 0.3, 1.5 * even}};
  const std::vector<Guide> jugular{{{19, 28.6, -5}, 1, 1.1},
                                   {{21.5, 30, 8}, 0.9, 1.3},
                                   {{26, 32.5, 27}, 0.5, 1.3},
                                   {{31, 35, 46}, 0.2, 1.2}};
  // Laterally `gap` behind and above the vein's axis (4 mm of tissue between the walls), medially
  // over the dome of the lung and behind the jugular vein.
  const double gap = vein_radius_mm + 4 + 4;
  const Vec3 offset = gap * Vec3(-1, 9.3, 8.6).normalized();
  const double wide = std::max(0.0, 1.5 * (vein_radius_mm - 4.5));  // behind wide veins
  const std::vector<Guide> artery{{Vec3(123, 54, -26) + 1.08 * offset, 0.1, 3.4},
                                  {Vec3(104, 45, -16) + 1.08 * offset, 0.2, 3.5},
                                  {Vec3(84, 37.5, -8.5) + 1.08 * offset, 0.5, 3.7},
                                  {Vec3(64, 31.5, -3) + 1.1 * offset, 0.9, 3.9},
                                  {Vec3(48, 27, 0) + 1.2 * offset, 1, 4.0},
                                  {{33, 41 + wide, 13}, 1, 4.1},
                                  {{20, 45.5 + wide, 11}, 0.9, 4.4},
                                  {{10, 47 + wide, -3}, 0.7, 5},
                                  {{4, 49 + wide, -22}, 0.4, 5.6},
                                  {{1, 51 + wide, -42}, 0.2, 5.8}};
  const double unit = vein_radius_mm;
  return {through(vein, shift, unit, 72), through(jugular, shift, std::sqrt(4.5 * unit), 24),
          through(artery, shift, 1, 72)};
}

}  // namespace palpa::anatomy
