#include "apps/twin/needle_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace palpa::twin {

NeedlePlan::NeedlePlan(const OperatorSkill& skill, const VisibleAnatomy& anatomy,
                       std::uint64_t seed)
    : skill_(skill), anatomy_(anatomy), seed_(seed), judgement_(seed, "operator.judgement.0") {}

void NeedlePlan::begin(int trial) {
  judgement_ = RandomStream(seed_, "operator.judgement." + std::to_string(trial));
  auto& j = judgement_;
  entry_A_ = anatomy_.entry_A +
             skill_.entry_sd * (j.normal() * anatomy_.medial_A + j.normal() * anatomy_.cephalad_A);
  normal_A_ = (anatomy_.normal_A + skill_.normal_sd * (j.normal() * anatomy_.medial_A +
                                                       j.normal() * anatomy_.cephalad_A))
                  .normalized();
  depth_error_ = j.normal(0, skill_.depth_sd);
  // Bevel up: toward the front of the patient who lies there, and a little to the head, which is up
  // while the needle stands on the skin. About the way to the middle of the body it is turned by
  // chance.
  RandomStream chance(seed_, "operator.bevel." + std::to_string(trial));
  bevel_A_ = Eigen::AngleAxisd(skill_.bevel_sd * chance.normal(), anatomy_.medial_A) *
             (0.3 * anatomy_.cephalad_A - anatomy_.posterior_A);
}

Vec3 NeedlePlan::firstAim(const Vec3& entered_A, bool feels) {
  const Vec3 aim = (anatomy_.aim_A - entered_A).normalized();
  const Vec3 to_bone = (anatomy_.cephalad_A - anatomy_.posterior_A).normalized();
  const double lean = std::min(feels ? skill_.guide : skill_.guide_unfelt, anatomy_.most_lean);
  return (aim + std::tan(lean) * to_bone +
          skill_.direction_sd * (judgement_.normal() * anatomy_.posterior_A +
                                 judgement_.normal() * anatomy_.cephalad_A))
      .normalized();
}

Vec3 NeedlePlan::redirected(const Vec3& axis_A, const Vec3& toward_A, int passes) {
  const Vec3 pattern[] = {anatomy_.posterior_A, anatomy_.cephalad_A, -anatomy_.posterior_A,
                          -anatomy_.cephalad_A};
  const Vec3 wanted = toward_A.isZero() ? pattern[passes % 4] : toward_A;
  const Vec3 toward = (wanted - wanted.dot(axis_A) * axis_A).normalized();
  const double angle = skill_.redirect + skill_.redirect_sd * judgement_.normal();
  return (std::cos(angle) * axis_A + std::sin(angle) * toward).normalized();
}

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
