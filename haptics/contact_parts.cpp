#include "haptics/contact_parts.h"

#include <algorithm>

namespace palpa::haptics {

void follow(PointMotion& motion, const Vec3& p_D, double tau, double dt) noexcept {
  if (!motion.started) {
    motion.v_D = {0, 0, 0};
  } else if (dt > 0) {
    const Vec3 raw = (p_D - unpack(motion.p_D)) / dt, v = unpack(motion.v_D);
    motion.v_D = pack(Vec3(v + (raw - v) * (dt / (tau + dt))));
  }
  motion.p_D = pack(p_D);
  motion.started = 1;
}

Vec3 dragAcross(Packed3& anchor_D, const Vec3& p_D, const Vec3& n_D, double k,
                double largest) noexcept {
  Vec3 drag = p_D - unpack(anchor_D);
  drag -= drag.dot(n_D) * n_D;
  const double size = drag.norm(), most = k > 0 ? largest / k : 0;
  if (size > most) drag *= most / size;
  anchor_D = pack(Vec3(p_D - drag));
  return -k * drag;
}

BoneTouch touchBones(const LocalGeometry& geometry, const Vec3& p_hub, const Vec3& p_tip,
                     double radius, double stiffness, Organ last) noexcept {
  BoneContact deepest[BoneTouch::kMost];
  int bone_of[BoneTouch::kMost];
  BoneTouch touch;
  for (int i = 0; i < geometry.bone_count; ++i) {
    const Capsule& capsule = geometry.bones[i];
    const BoneContact c = bonePenetration(capsule, p_hub, p_tip, radius);
    if (c.penetration <= 0) continue;
    int k = 0;
    while (k < touch.count && bone_of[k] != capsule.bone) ++k;
    if (k == touch.count) {
      bone_of[k] = capsule.bone;
      ++touch.count;
    }
    if (c.penetration > deepest[k].penetration) deepest[k] = c;
  }
  for (int k = 0; k < touch.count; ++k) {
    const double f = stiffness * deepest[k].penetration;
    touch.each[k] = {f * deepest[k].n_D, deepest[k].p_D};
    if (f <= touch.largest) continue;
    touch.largest = f;
    touch.organ = deepest[k].organ;
  }
  if (touch.organ != Organ::none && last == Organ::none) touch.events |= kBoneTouched;
  if (touch.organ == Organ::none && last != Organ::none) touch.events |= kBoneLeft;
  return touch;
}

}  // namespace palpa::haptics
