#pragma once

#include <array>

#include "anatomy/geometry/pose.h"
#include "haptics/augmentation/augmentation.h"

namespace palpa::haptics {

/// What the force of a tick is made of, and what its parts were computed from. Not recorded:
/// whoever runs a recorded tick again has it. Frame D, N, m; zero where there is none.
///   f_contact      = body + stiffness + friction + weight + taken + texture + lumps
///   f_augmentation = pulse + sum of cues
///   f_wanted       = rendered (f_contact + f_augmentation) + held + damping
///   f_command      = f_wanted, limited
struct TickForces {
  Vec3 body = Vec3::Zero();       ///< of a virtual body: patient or floor
  Vec3 stiffness = Vec3::Zero();  ///< (k~ x - f_n) u_n: another stiffness than the real object's
  Vec3 friction = Vec3::Zero();   ///< f_targ - f_real: another friction than the real surface's
  Vec3 weight = Vec3::Zero();     ///< another weight than that of what is squeezed
  Vec3 taken = Vec3::Zero();      ///< takes a real lump away
  Vec3 texture = Vec3::Zero();
  Vec3 lumps = Vec3::Zero();  ///< of the virtual lumps, with what they add to the friction
  Vec3 pulse = Vec3::Zero();  ///< of an artery
  std::array<Vec3, kMostAugmentations> cues = zeros();  ///< in the order of the plan, bounded
  Vec3 held = Vec3::Zero();     ///< carries the handle, or holds it where an episode starts
  Vec3 damping = Vec3::Zero();  ///< of the passivity control
  double rendered = 0;          ///< 0 to 1, by the age of the geometry; 0 without force feedback

  Vec3 normal = Vec3::Zero();      ///< unit, outward, of the real object as it is estimated
  Vec3 slid = Vec3::Zero();        ///< how far the tip slid over it in this tick
  Vec3 up = Vec3::Zero();          ///< unit: the way of cues that push up
  Vec3 on_floor_U = Vec3::Zero();  ///< the probe in F, U
  double footprint = 0;            ///< 0 to 1: of the highest bump, the one under the probe
  Vec3 to_valley = Vec3::Zero();   ///< along the floor
  double valley_radius_U = 0;      ///< 0: none is near
  Vec3 to_line = Vec3::Zero();     ///< of a guide, across it
  Vec3 out_of = Vec3::Zero();      ///< of the regions that are kept out of

  static std::array<Vec3, kMostAugmentations> zeros() noexcept {
    std::array<Vec3, kMostAugmentations> none;
    none.fill(Vec3::Zero());
    return none;
  }
};

}  // namespace palpa::haptics
