#include "haptics/bone_contact.h"

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

}  // namespace palpa::haptics
