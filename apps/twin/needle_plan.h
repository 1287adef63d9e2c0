#pragma once

#include <cstdint>

#include "anatomy/base/random.h"
#include "anatomy/geometry/pose.h"
#include "anatomy/query/surface_query.h"
#include "apps/twin/operator_skills.h"

namespace palpa::twin {

/// What anybody can see or palpate on the displayed patient.
struct VisibleAnatomy {
  Vec3 entry_A;          ///< 1 cm below the junction of medial and middle thirds
  Vec3 normal_A;         ///< of the skin there
  Vec3 aim_A;            ///< where the needle is pointed: by the landmarks
  double vein_distance;  ///< m, entry to vein along the needle, as far as he knows
  Vec3 medial_A, posterior_A, cephalad_A;  ///< unit directions by the landmarks
  double most_lean = 1;  ///< rad, toward the bone: the middle half of the vein as it was seen
};

/// Where somebody who has studied a patient's pictures would meet the vein, in A, metres: on the
/// vein's axis, as near to `guess_A` (where it lies in the mean anatomy) as a straight needle from
/// `entry_A` comes that stays 2 mm off the clavicle, 3 mm off the pleura before the vein, and meets
/// the vein first [chosen]. Where no such way is seen: the middle of the vein nearest to the guess.
/// Without a vein: the guess.
struct SeenVein {
  Vec3 aim_A;
  double radius;  ///< m, of the vein there; 0 where none is seen
};
SeenVein aimByPictures(const anatomy::Patient& patient, const anatomy::SurfaceQuery& query,
                       const Vec3& entry_A, const Vec3& guess_A);

/// Where a simulated operator means the needle to go in one trial, by what can be seen and palpated
/// and with the own mistakes, drawn for each trial from its seed. Frame A; unit directions.
class NeedlePlan {
 public:
  NeedlePlan(const OperatorSkill& skill, const VisibleAnatomy& anatomy, std::uint64_t seed);

  void begin(int trial);
  const Vec3& entry_A() const { return entry_A_; }
  const Vec3& normal_A() const { return normal_A_; }  ///< along which it goes through the skin
  const Vec3& bevel_A() const { return bevel_A_; }    ///< whither its opening is turned
  double depthError() const { return depth_error_; }  ///< m, in judging how deep the needle is
  /// Behind the skin, from where it was entered. Whoever leans toward the clavicle to be guided by
  /// it does so less where the skin was not felt.
  Vec3 firstAim(const Vec3& entered_A, bool feels);
  /// After `passes` of them by a small angle away from `axis_A`: toward `toward_A`, where that is
  /// zero to each side in turn.
  Vec3 redirected(const Vec3& axis_A, const Vec3& toward_A, int passes);

 private:
  OperatorSkill skill_;
  VisibleAnatomy anatomy_;
  std::uint64_t seed_;
  RandomStream judgement_;
  Vec3 entry_A_ = Vec3::Zero(), normal_A_ = Vec3::UnitZ(), bevel_A_ = Vec3::UnitY();
  double depth_error_ = 0;
};

}  // namespace palpa::twin
