#include "haptics/contact/contact_parts.h"

#include <algorithm>

namespace palpa::haptics {
namespace {

constexpr double kTiny = 1e-12;

/// Parameters (s, t) in [0, 1] of the closest points of p + s d and q + t e.
void closestParameters(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e, double* s,
                       double* t) {
  const Vec3 r = p - q;
  const double a = d.squaredNorm(), c = e.squaredNorm(), b = d.dot(e);
  const double dr = d.dot(r), er = e.dot(r);
  const double denominator = a * c - b * b;
  *s = denominator > kTiny * a * c ? std::clamp((b * er - c * dr) / denominator, 0.0, 1.0) : 0.0;
  *t = c > kTiny ? (b * *s + er) / c : 0.0;
  if (*t >= 0 && *t <= 1) return;
  *t = std::clamp(*t, 0.0, 1.0);
  *s = a > kTiny ? std::clamp((b * *t - dr) / a, 0.0, 1.0) : 0.0;
}

}  // namespace

BoneContact bonePenetration(const Capsule& bone, const Vec3& p_hub, const Vec3& p_tip,
                            double needle_radius) noexcept {
  const Vec3 shaft = p_tip - p_hub, a = unpack(bone.a), core = unpack(bone.b) - a;
  double s = 0, t = 0;
  closestParameters(p_hub, shaft, a, core, &s, &t);
  BoneContact contact;
  contact.p_D = p_hub + s * shaft;
  const Vec3 apart = contact.p_D - (a + t * core);
  const double distance = apart.norm();
  contact.penetration = std::max(0.0, bone.radius + needle_radius - distance);
  if (distance > kTiny) contact.n_D = apart / distance;
  contact.organ = contact.penetration > 0 ? bone.organ : Organ::none;
  return contact;
}

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
