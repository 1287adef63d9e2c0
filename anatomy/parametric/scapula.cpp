#include <algorithm>

#include "anatomy/parametric/thorax.h"
#include "anatomy/shapes/surface_nets.h"
#include "anatomy/triangle_distance.h"

namespace palpa::anatomy {
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
