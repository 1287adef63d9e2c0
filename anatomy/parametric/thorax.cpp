#include "anatomy/parametric/thorax.h"

#include <algorithm>
#include <cmath>

#include "anatomy/shapes/spline.h"
#include "anatomy/shapes/surface_nets.h"

namespace palpa::anatomy {
namespace {

Rib makeRib(const std::vector<Vec3>& guides, const Vec3& broad, double half_broad,
            double half_thick) {
  const Curve curve(guides);
  std::vector<Section> sections = sectionsAlong(curve.sample(72), broad);
  // Round cartilage at the sternum, a slight waist at the joint with the bone, then a flat bar.
  const Spline broadness{{0, 0.82}, {0.12, 0.90}, {0.24, 0.94}, {0.30, 1.06}, {0.4, 1}, {1, 0.9}};
  const Spline thickness{{0, 1.40}, {0.12, 1.35}, {0.24, 1.22}, {0.30, 1.24}, {0.4, 1}, {1, 1}};
  std::vector<TubeField::Station> stations;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double u = double(i) / (sections.size() - 1);
    sections[i].half_up = half_broad * broadness(u);
    sections[i].half_side = half_thick * thickness(u);
    if (i % 3 == 0 || i + 1 == sections.size())
      stations.push_back(
          {sections[i].centre, std::max(sections[i].half_up, sections[i].half_side)});
  }
  return {TubeField(std::move(stations)), sweep(sections, 24, 0.7)};
}

// Rounded box |p| <= half.
double roundedBox(const Vec3& p, const Vec3& half, double radius) {
  const Vec3 q = p.cwiseAbs() - half + Vec3::Constant(radius);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
}

double sternumField(const Vec3& p, const Clavicle& clavicle) {
  const double l = std::abs(p.x()), z = p.z();
  // Broad above, narrow at the sternal angle, the body below; the plane leans backward upward.
  const double half = z > -48 ? 15.5 + 13.5 * std::pow((z + 48) / 40, 1.2)
                              : 16.5 - 1.5 * std::exp((z + 48) / 6) + 0.045 * (-48 - z);
  const double middle = 8.5 + 0.20 * z + (z < -48 ? 0.06 * (-48 - z) : 0.0);
  const double plate = roundedBox({0, p.y() - middle, z + 66}, {1, 5.5, 62}, 4);
  double f = smoothMax(plate, 0.85 * (l - half), 5);
  const double notch = 16 - std::hypot(p.x(), z - 9);  // jugular notch
  const double angle_groove = 1.6 - std::hypot(p.y() - (middle - 6.4), z + 48);
  f = smoothMax(f, notch, 8);
  f = smoothMax(f, angle_groove, 3);
  const double facet = 0.5 - clavicle.tube({l, p.y(), z});  // clavicular notch with its disc
  return smoothMax(f, facet, 8);
}

// The lung without its neighbours: sections that grow downward from the apex.
double bareLung(const Vec3& p, double shift_y) {
  static const Spline half_width{{0, 6},   {5, 12},  {14, 18.5}, {28, 23},
                                 {45, 28}, {65, 36}, {95, 43},   {165, 48}};
  static const Spline half_depth{{0, 6},   {5, 11},  {14, 17.5}, {22, 22.5}, {29, 26.5},
                                 {45, 31}, {65, 33}, {95, 34},   {165, 35}};
  static const Spline centre{{0, 35}, {14, 34}, {28, 33}, {45, 37}, {65, 45}, {95, 54}, {165, 60}};
  constexpr double kApex = 30;
  const double below = kApex - p.z();
  const double h = std::max(below, 0.0);
  const double a = half_width(h), b = half_depth(h);
  const double back = 57.5 - std::min(0.06 * h, 6.0) + shift_y;
  const double u = std::abs((p.x() - centre(h)) / a), v = std::abs((p.y() - back) / b);
  const double power = 2.2 + 0.6 * std::min(h / 100, 1.0);
  const double side =
      (std::pow(std::pow(u, power) + std::pow(v, power), 1 / power) - 1) * std::min(a, b);
  double f = smoothMax(0.8 * side, -below, 12);
  return smoothMax(f, -132 - p.z(), 10);
}

}  // namespace

std::vector<Rib> makeRibs(double vein_radius_mm) {
  const double drop = 1.4 * std::max(0.0, vein_radius_mm - 4.5);
  std::vector<Rib> ribs;
  ribs.push_back(makeRib({{25.5, 12, -19},
                          {40, 21, -20 - drop},
                          {52, 32, -17.5 - drop},
                          {59.5, 47, -10 - drop},
                          {60, 62, -1},
                          {53, 78, 9},
                          {40, 90, 16},
                          {27, 95, 19}},
                         Vec3(0.35, -0.55, 0.1), 6.5, 3.0));
  ribs.push_back(makeRib({{19, 2.2, -50},
                          {40, 6.5, -51},
                          {64, 15, -50},
                          {84, 31, -45},
                          {92, 52, -34},
                          {86, 74, -19},
                          {68, 90, -5},
                          {50, 96, 2}},
                         Vec3(0.15, -0.25, 1), 6.5, 3.0));
  ribs.push_back(makeRib({{21, -2.2, -82},
                          {44, 0.5, -86},
                          {72, 9, -87},
                          {96, 27, -83},
                          {106, 50, -71},
                          {101, 73, -55},
                          {84, 90, -40},
                          {64, 96, -30}},
                         Vec3(0.05, -0.1, 1), 6.8, 3.2));
  return ribs;
}

TriangleMesh makeSternum(const Clavicle& clavicle) {
  const auto field = [&](const Vec3& p) { return sternumField(p, clavicle); };
  return surfaceNets(field, {Vec3(-36, -26, -134), Vec3(36, 26, 4)}, 1.8);
}

TriangleMesh makeLung(const Vessels& vessels, const std::vector<Rib>& ribs, double shift_y,
                      double groove_mm) {
  const auto field = [&](const Vec3& p) {
    double f = bareLung(p, shift_y);
    if (f > 12) return f;
    for (const Rib& rib : ribs) f = smoothMax(f, 1.5 - rib.tube(p), 8);
    f = smoothMax(f, 2.5 - vessels.artery(p), 7);
    return smoothMax(f, groove_mm - vessels.veinField(p), 4);
  };
  return surfaceNets(field, {Vec3(-20, 5, -142), Vec3(125, 110, 42)}, 2.8, 2.5);
}

}  // namespace palpa::anatomy
