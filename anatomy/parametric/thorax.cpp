#include "anatomy/parametric/thorax.h"

#include <algorithm>
#include <cmath>

#include "anatomy/query/triangle_distance.h"
#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/mesh_tools.h"
#include "anatomy/shapes/spline.h"

namespace palpa::anatomy {
namespace {

// y of the sternum's middle: its plane leans backward upward and bends at the sternal angle. `low`:
// z in the shapes' body.
double sternumMiddle(double low) {
  return 8.5 + 0.20 * low + (low < -48 ? 0.06 * (-48 - low) : 0.0);
}

double sternumField(const Vec3& p, const Clavicle& clavicle, const Build& build) {
  const double l = std::abs(p.x()), z = p.z(), low = build.unplace(p).z();
  // Broad above, narrow at the sternal angle, the body below, the xiphoid's tongue at its end.
  const double body = 16.5 - 1.5 * std::exp(std::min((low + 48) / 6, 0.0)) + 0.045 * (-48 - low);
  double half = low > -48 ? 15.5 + 13.5 * std::pow((low + 48) / 40, 1.2) : body;
  if (low < -138) half = std::max(body - 0.85 * (-138 - low), 4.2);
  // Notches for the cartilages of the ribs.
  for (const double rib : {-50.0, -82.0, -106.0, -126.0, -141.0})
    half -= 2.2 * std::exp(-0.5 * std::pow((low - rib) / 5, 2));
  const double middle = sternumMiddle(low);
  const double end = std::max(build.place({0, 0, -180}).z(), build.floor(9));
  const double thick = low < -150 ? 3.6 : 5.5;
  double f = smoothMax(std::abs(p.y() - middle) - thick, 0.85 * (l - half), 6);
  f = smoothMax(smoothMax(f, p.z() + 4, 5), end - p.z(), 6);
  const double notch = 16 - std::hypot(p.x(), z - 9);  // jugular notch
  const double angle_groove = 1.6 - std::hypot(p.y() - (middle - 6.4), low + 48);
  f = smoothMax(f, notch, 8);
  f = smoothMax(f, angle_groove, 3);
  const double facet = 0.5 - clavicle.tube({l, p.y(), z});  // clavicular notch with its disc
  return smoothMax(f, facet, 8);
}

// The middle of the vertebral bodies: T1 to T8, kyphotic.
Vec3 spineMiddle(const Build& build, double low) {
  static const Spline y{{-170, 122}, {-120, 118}, {-70, 108}, {-20, 95}, {20, 84}, {50, 76}};
  return build.place({0, y(low), low});
}

double spineField(const Vec3& p, const Build& build) {
  constexpr double kHeight = 21.5,
                   kTop = 34;  // of a vertebra with its disc; upper end of the first
  const double low = build.unplace(p).z();
  const Vec3 middle = spineMiddle(build, low);
  const double phase = 2 * M_PI * (kTop - low) / kHeight;
  const double waist = 1.1 * std::cos(2 * phase) + 0.9 * std::cos(phase);
  const double body = 0.9 * (std::hypot(p.x() / 1.15, p.y() - middle.y()) - 13 - 0.9 * waist);
  // Processes: one backward and down from each vertebra, two to the sides.
  const double nearest = kTop - kHeight * (std::floor((kTop - low) / kHeight) + 0.5);
  double processes = 40;
  for (const double shift : {-kHeight, 0.0, kHeight}) {
    const double at = nearest + shift;
    if (at > kTop || at < -160) continue;
    const Vec3 m = spineMiddle(build, at);
    const auto bar = [&](const Vec3& a, const Vec3& b, double ra, double rb) {
      const Vec3 ab = b - a;
      const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      return (p - a - t * ab).norm() - (ra + t * (rb - ra));
    };
    processes = std::min(processes, bar(m + Vec3(0, 16, 0), m + Vec3(0, 40, -17), 5.5, 3));
    for (const double side : {-1.0, 1.0})
      processes =
          std::min(processes, bar(m + Vec3(side * 9, 18, 0), m + Vec3(side * 25, 31, 4), 5, 3.5));
  }
  const double arch = std::hypot(p.x(), p.y() - middle.y() - 19) - 9.5;
  double f = smoothMin(smoothMin(body, arch, 5), processes, 5);
  f = smoothMax(f, p.z() - build.place({0, 0, kTop}).z(), 4);
  return smoothMax(f, std::max(build.place({0, 0, -160}).z(), build.floor(9)) - p.z(), 4);
}

// The lung's dome in the root of the neck: sections that grow downward from the apex.
double dome(const Vec3& p, double shift_y) {
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
  return smoothMax(smoothMax(0.8 * side, -below, 12), -90 - p.z(), 10);
}

// What the ribs enclose beside the mediastinum, from the second rib down to the diaphragm's dome.
double cageSide(const Vec3& p, const Build& build, bool heart) {
  static const Spline wide{{-215, 124}, {-170, 124}, {-130, 119}, {-95, 108}, {-60, 91},
                           {-40, 78},   {-20, 60},   {0, 46},     {20, 34}};
  static const Spline front{{-215, -2}, {-150, -3}, {-110, 2}, {-80, 8},
                            {-50, 15},  {-20, 27},  {0, 38},   {20, 46}};
  static const Spline behind{{-215, 136}, {-150, 135}, {-110, 128}, {-70, 116},
                             {-40, 105},  {-10, 94},   {20, 82}};
  const Vec3 t = build.unplace(p);
  const double a = wide(t.z()), yf = front(t.z()), yb = behind(t.z());
  const double yc = (yf + yb) / 2, b = (yb - yf) / 2;
  const double u = std::abs(t.x()) / a, v = std::abs(t.y() - yc) / b;
  double f = 0.8 * (std::pow(std::pow(u, 2.3) + std::pow(v, 2.3), 1 / 2.3) - 1) * std::min(a, b);
  // Mediastinum: wider for the heart on its side; in front the lungs nearly meet.
  const double heart_bulge =
      (heart ? 26 : 10) *
      std::exp(-0.5 * (std::pow((t.z() + 130) / 42, 2) + std::pow((t.y() - 35) / 32, 2)));
  const double medial = 15 + 14 * std::exp(-0.5 * std::pow((t.y() - 95) / 26, 2)) +
                        6 * std::exp(-0.5 * std::pow((t.y() - 50) / 22, 2)) + heart_bulge;
  f = smoothMax(f, medial - t.x(), 14);
  f = smoothMax(f, p.z() - build.place({0, 0, 12}).z(), 30);
  // Diaphragm: a dome higher in the middle of the lung's base.
  const double r2 = std::pow((t.x() - 72) / 62, 2) + std::pow((t.y() - 62) / 70, 2);
  const double floor = -190 + 34 * std::max(0.0, 1 - r2);
  return smoothMax(f, 0.8 * (std::max(build.place({0, 0, floor}).z(), build.floor(9)) - p.z()), 9);
}

constexpr double kLungCell = 3.5;

// The box grown to cells counted from `origin`, so that a part is meshed as the whole is.
Eigen::AlignedBox3d onGrid(const Eigen::AlignedBox3d& box, const Vec3& origin, double cell) {
  const Vec3 low = (box.min() - origin).array() / cell;
  return {Vec3(origin.array() + cell * low.array().floor()), box.max()};
}

}  // namespace

TriangleMesh makeSternum(const Clavicle& clavicle, const Build& build) {
  const auto field = [&](const Vec3& p) { return sternumField(p, clavicle, build); };
  return surfaceNets(field, {Vec3(-36, -34, build.place({0, 0, -186}).z()), Vec3(36, 26, 6)}, 1.9);
}

TriangleMesh makeSpine(const Build& build) {
  const auto field = [&](const Vec3& p) { return spineField(p, build); };
  return surfaceNets(
      field,
      {Vec3(-36, 50, build.place({0, 0, -170}).z()), Vec3(36, 176, build.place({0, 0, 42}).z())},
      3.2);
}

std::vector<TubeField> airwayTubes(double handed) {
  return {TubeField({{{0, 28, 66}, 9},
                     {{0, 32, 20}, 9},
                     {{-1 * handed, 42, 2}, 8.5},
                     {{-2 * handed, 59.5, -22}, 8.5},
                     {{-1 * handed, 70, -48}, 8.6},
                     {{handed, 76, -62}, 9}}),
          TubeField({{{handed, 76, -62}, 7.5}, {{handed * 24, 82, -84}, 7}}),
          TubeField({{{handed, 76, -62}, 6.5}, {{-handed * 24, 66, -90}, 6}})};
}

TriangleMesh makeAirway(const Vessels& vessels) {
  const std::vector<TubeField> tubes = airwayTubes(vessels.handed);
  const auto rings = [](double z) {
    return 0.35 * std::cos(2 * M_PI * z / 5.2);
  };  // the cartilages show
  const auto field = [&](const Vec3& p) {
    double f = smoothMin(smoothMin(tubes[0](p), tubes[1](p), 5), tubes[2](p), 5) - rings(p.z());
    if (f > 8) return f;
    f = smoothMax(f, 1.2 - vessels.arteryField(p), 4);
    return smoothMax(f, 1.2 - vessels.veinField(p), 4);
  };
  return surfaceNets(field, {Vec3(-42, 12, -100), Vec3(42, 98, 82)}, 2.0);
}

TriangleMesh makeLung(const Vessels& vessels, const std::vector<Rib>& ribs, const Build& build,
                      double sign, double shift_y, double groove_mm,
                      const Eigen::AlignedBox3d& part) {
  const bool heart = sign * vessels.handed < 0;  // on the patient's left
  const std::vector<TubeField> airway = airwayTubes(vessels.handed);
  const auto field = [&](const Vec3& p) {
    double f = smoothMin(dome(p, shift_y), cageSide(p, build, heart), 16);
    if (f > 12) return f;
    const Vec3 there(sign * p.x(), p.y(), p.z());
    for (const Rib& rib : ribs) f = carveTube(f, rib.tube, p, 1.5, 8);
    // No fins between the vessels at the root of the neck.
    f = smoothMax(f, 13 + 8 * softStep(p.z() + 22, 8) - p.x(), 8);
    for (const TubeField& tube : airway) f = carveTube(f, tube, there, 3, 7);
    for (const TubeField& tube : vessels.arteries) f = carveTube(f, tube, there, 2.5, 9);
    if (groove_mm - vessels.veinsAtLeast(there) <= f - 4) return f;
    return smoothMax(f, groove_mm - vessels.veinField(there), 4);
  };
  Eigen::AlignedBox3d box(Vec3(-4, -30, build.place({0, 0, -205}).z()),
                          Vec3(build.place({140, 0, 0}).x(), 152, 42));
  if (!part.isEmpty()) box = onGrid(part.intersection(box), box.min(), kLungCell);
  TriangleMesh mesh = surfaceNets(field, box, kLungCell, 2.5);
  return sign > 0 ? mesh : mirroredMesh(mesh);
}

namespace {

double plate(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double half) {
  const Vec3 w = closestWeights(p, a, b, c);
  return (p - w.x() * a - w.y() * b - w.z() * c).norm() - half;
}

}  // namespace

Vec3 coracoid(const Clavicle& clavicle) { return clavicle.acromial_end + Vec3(-24, -10, -25); }

TriangleMesh makeScapula(const Clavicle& clavicle, const Build& build) {
  const Vec3 acromion = clavicle.acromial_end;
  const Vec3 superior = build.place({72, 122, 14}), inferior = build.place({90, 156, -122});
  const Vec3 root = build.place({76, 140, -14}), socket = acromion + Vec3(-6, 30, -42);
  const Vec3 neck = socket + Vec3(-14, 8, 2), tip = acromion + Vec3(10, 7, -3);
  // The spine of the scapula rises from the blade and ends as the acromion behind and beside the
  // clavicle's end.
  const TubeField spine({{root, 3.5},
                         {acromion + Vec3(-34, 52, -12), 5},
                         {acromion + Vec3(0, 30, -1), 6},
                         {tip, 6.5}});
  const TubeField beak(
      {{neck + Vec3(0, -6, 10), 7}, {acromion + Vec3(-27, 12, -16), 6}, {coracoid(clavicle), 5}});
  const TubeField border({{neck, 6}, {build.place({104, 150, -92}), 4.5}, {inferior, 4.5}});
  const auto field = [&](const Vec3& p) {
    double f =
        smoothMin(plate(p, superior, root, neck, 2.0), plate(p, root, inferior, neck, 2.0), 3);
    f = smoothMin(f, border(p), 5);
    f = smoothMin(f, ((p - socket).cwiseQuotient(Vec3(0.7, 1, 1.4)).norm() - 12) * 0.8, 8);
    f = smoothMin(f, smoothMin(spine(p), beak(p), 6), 5);
    return smoothMax(f, 1.2 - clavicle.tube(p), 3);  // the acromioclavicular joint
  };
  Eigen::AlignedBox3d box;
  for (const Vec3& p : {superior, inferior, root, socket, tip, coracoid(clavicle)}) {
    box.extend(Vec3(p.array() - 26));
    box.extend(Vec3(p.array() + 26));
  }
  return surfaceNets(field, box, 2.8);
}

}  // namespace palpa::anatomy
