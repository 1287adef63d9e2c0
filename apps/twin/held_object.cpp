#include "apps/twin/held_object.h"

namespace palpa::twin {
namespace {

constexpr double kGravity = 9.80665;  // m/s^2
constexpr double kStand = 2000, kStandDamping = 6,
                 kNest = 1e-3;  // N/m, N s/m; m: so deep it sits in the stand [chosen: it rests
                                // within 0.1 mm, and does not bounce]

Vec3 mirrored(const Vec3& p) { return {-p.x(), p.y(), p.z()}; }

}  // namespace

/// Pushes up what comes down on it, and toward its middle what still sits in it.
Vec3 HeldObject::onStand() const {
  Vec3 f = Vec3::Zero();
  if (p_.z() < 0) f.z() = std::max(-kStand * p_.z() - kStandDamping * v_.z(), 0.0);
  if (p_.z() < kNest) f.head<2>() = -kStand * p_.head<2>() - kStandDamping * v_.head<2>();
  return f;
}

std::array<Vec3, 2> HeldObject::step(const std::array<Vec3, 2>& p_O, double dt, bool held) {
  std::array<Vec3, 2> f;
  Vec3 on_object(0, 0, -shape_.mass * kGravity);
  for (std::size_t t = 0; t < 2; ++t) {
    const Vec3 from = p_O[t] - p_,
               out = t == 0 ? from : mirrored(from);  // in the side's frame its outward normal is z
    const Vec3 touch = sides_[t].step({-out.z(), out.y(), out.x() - shape_.half}, dt).f;
    const Vec3 on_tool(touch.z(), touch.y(), -touch.x());
    f[t] = t == 0 ? on_tool : mirrored(on_tool);
    on_object -= f[t];
  }
  if (held) return f;
  v_ += (on_object + onStand()) / shape_.mass * dt;
  p_ += v_ * dt;
  return f;
}

}  // namespace palpa::twin
