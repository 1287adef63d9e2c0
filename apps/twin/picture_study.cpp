#include <algorithm>
#include <limits>
#include <vector>

#include "apps/twin/needle_plan.h"

namespace palpa::twin {
namespace {

constexpr double kReach = 0.010;  // m of vein that is looked at as one straight tube
constexpr double kAlong = 0.015, kStride = 0.001;       // m, along the vein
constexpr double kOffBone = 0.002, kOffPleura = 0.003;  // m

std::vector<int> surfacesOf(const anatomy::Patient& patient, Organ organ) {
  std::vector<int> all;
  for (std::size_t i = 0; i < patient.organs.size(); ++i)
    if (patient.organs[i].organ == organ) all.push_back(static_cast<int>(i));
  return all;
}

class Pictures {
 public:
  Pictures(const anatomy::Patient& patient, const anatomy::SurfaceQuery& query, const Vec3& entry_A)
      : patient_(patient), query_(query), entry_A_(entry_A) {}

  /// The middle of the vein at the place of its wall that is nearest.
  bool middleNear(const Vec3& p_A, SeenVein* seen) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int vein : surfacesOf(patient_, Organ::vein)) {
      const anatomy::SurfacePoint wall = query_.closest(vein, p_A);
      anatomy::SurfaceQuery::Tube tube;
      if (std::abs(wall.distance) >= nearest || !query_.fitTube(vein, wall.p_A, kReach, &tube))
        continue;
      nearest = std::abs(wall.distance);
      const Vec3 axis = (tube.b_A - tube.a_A).normalized();
      *seen = {tube.a_A + (wall.p_A - tube.a_A).dot(axis) * axis, tube.radius};
    }
    return std::isfinite(nearest);
  }

  /// Past the bone and the pleura, and the vein first of what must not be met by chance.
  bool isWay(const Vec3& to_A) const {
    for (const int bone : surfacesOf(patient_, Organ::clavicle))
      if (query_.nearSegment(bone, entry_A_, to_A).distance < kOffBone) return false;
    for (const int lung : surfacesOf(patient_, Organ::lung))
      if (query_.nearSegment(lung, entry_A_, to_A).distance < kOffPleura) return false;
    const Vec3 way = to_A - entry_A_;
    for (const anatomy::RayHit& hit : query_.cast(entry_A_, way.normalized(), way.norm()))
      if (hit.organ != Organ::skin && hit.organ != Organ::fascia && hit.organ != Organ::muscle)
        return hit.organ == Organ::vein;
    return false;
  }

 private:
  const anatomy::Patient& patient_;
  const anatomy::SurfaceQuery& query_;
  const Vec3 entry_A_;
};

}  // namespace

SeenVein aimByPictures(const anatomy::Patient& patient, const anatomy::SurfaceQuery& query,
                       const Vec3& entry_A, const Vec3& guess_A) {
  const Pictures pictures(patient, query, entry_A);
  SeenVein nearest, ahead;
  if (!pictures.middleNear(guess_A, &nearest)) return {guess_A, 0};
  Vec3 along = Vec3::Zero();
  if (pictures.middleNear(guess_A + kReach * (nearest.aim_A - entry_A).normalized(), &ahead) &&
      (ahead.aim_A - nearest.aim_A).norm() > kStride)
    along = (ahead.aim_A - nearest.aim_A).normalized();
  for (double away = 0; away <= kAlong; away += kStride)
    for (const double sign : {1.0, -1.0}) {
      SeenVein there;
      if (pictures.middleNear(nearest.aim_A + sign * away * along, &there) &&
          pictures.isWay(there.aim_A))
        return there;
    }
  return nearest;
}

}  // namespace palpa::twin
