#include "apps/twin/phantom/silicone_contact.h"

#include <algorithm>
#include <cmath>

namespace palpa::twin {

PhantomTouch SiliconeContact::step(const Vec3& elastic, const Vec3& tip, double dt) {
  const Vec3 dp = started_ ? Vec3(tip - last_) : Vec3(Vec3::Zero());
  last_ = tip;
  started_ = true;
  PhantomTouch touch;
  touch.x = std::max(0.0, -tip.z());
  const double f = elastic.norm();
  double now = f;
  for (std::size_t i = 0; i < extra_.size(); ++i) {
    extra_[i] =
        (extra_[i] + law_.relaxes[i] * (f - elastic_)) * std::exp(-dt / law_.relaxation_time[i]);
    now += extra_[i];
  }
  elastic_ = f;
  touch.contact = f > 0 && now > 0;
  if (!touch.contact) {
    drag_.setZero();
    return touch;
  }
  touch.n = elastic / f;
  touch.f_n = now;
  touch.f = now * touch.n - drag(touch, dp, dt);
  return touch;
}

/// dF = sigma (dp - F |dp| / F_c), within F_c; F_c falls with speed and grows a little less than
/// the load, which no law that is identified knows. Along the undeformed surface: what is pressed
/// straight down takes the rubber below along and does not rub.
Vec3 SiliconeContact::drag(const PhantomTouch& touch, const Vec3& dp, double dt) {
  constexpr int kParts = 40;
  const Vec3 along(dp.x(), dp.y(), 0), part = along / kParts;
  const double speed = along.norm() / dt / law_.sticks_below;
  const double most = law_.mu * (1 + law_.sticks * std::exp(-speed * speed)) *
                      std::pow(touch.f_n, 1 + law_.load_power);
  for (int i = 0; i < kParts; ++i) {
    drag_ += law_.sigma * (part - drag_ * (part.norm() / most));
    if (drag_.norm() > most) drag_ *= most / drag_.norm();
  }
  return drag_ + law_.B * along / dt;
}

}  // namespace palpa::twin
