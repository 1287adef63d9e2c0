#include "apps/twin/phantom/phantom_twin.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"

namespace palpa::twin {

PhantomTouch SiliconeContact::step(const Vec3& elastic, const Vec3& tip, double dt, double rubs) {
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
  touch.f = now * touch.n - drag(touch, dp, dt, rubs);
  return touch;
}

/// dF = sigma (dp - F |dp| / F_c), within F_c; F_c falls with speed and grows a little less than
/// the load, which no law that is identified knows. Along the undeformed surface: what is pressed
/// straight down takes the rubber below along and does not rub.
Vec3 SiliconeContact::drag(const PhantomTouch& touch, const Vec3& dp, double dt, double rubs) {
  constexpr int kParts = 40;
  const Vec3 along(dp.x(), dp.y(), 0), part = along / kParts;
  const double speed = along.norm() / dt / law_.sticks_below;
  const double most = rubs * law_.mu * (1 + law_.sticks * std::exp(-speed * speed)) *
                      std::pow(touch.f_n, 1 + law_.load_power);
  for (int i = 0; i < kParts; ++i) {
    drag_ += law_.sigma * (part - drag_ * (part.norm() / most));
    if (drag_.norm() > most) drag_ *= most / drag_.norm();
  }
  return drag_ + law_.B * along / dt;
}

namespace {

double depthOf(const Vec3& tip) { return std::max(0.0, -tip.z()); }

/// Of the table, about its axis; `more`: elastic force beside the table's, N.
PhantomTouch stepAlone(const PhantomTable& table, SiliconeContact& contact, const Vec3& tip,
                       double dt, const Vec3& more = Vec3::Zero()) {
  const double away = tip.head<2>().norm();
  const Vec3 out = away > 0 ? Vec3(tip.x() / away, tip.y() / away, 0) : Vec3(Vec3::UnitX());
  const PhantomCell cell = table.at(away, depthOf(tip));
  PhantomTouch touch = contact.step(cell.f_out * out + cell.f_up * Vec3::UnitZ() + more, tip, dt);
  touch.lump = cell.lump_out * out + cell.lump_up * Vec3::UnitZ();
  return touch;
}

}  // namespace

PhantomTouch PhantomTwin::step(const Vec3& tip, double dt) {
  return stepAlone(table_, contact_, tip, dt);
}

/// The silicone's own frame: z is the normal under the tip.
PhantomTouch CurvedPhantomTwin::step(const Vec3& middle, double dt) {
  constexpr double kLeast = 0.25;  // of 1 + r k: in a hollow as narrow as the tip Hertz's law ends
  const TopFoot foot = nearestOn(top_, middle);
  const Mat3 R = turnToNormal(foot.n);
  if (started_) gone_ += R.transpose() * (middle - last_);
  last_ = middle;
  started_ = true;
  const double depth = std::max(0.0, table_.tool_radius - foot.over);
  const auto [most, least] = curvaturesOf(top_, foot.p.x(), foot.p.y());
  const double bent = 1 + table_.tool_radius * 0.5 * (most + least);
  const double elastic = table_.at(0, depth).f_up / std::sqrt(std::max(bent, kLeast));
  PhantomTouch touch =
      contact_.step(elastic * Vec3::UnitZ(), Vec3(gone_.x(), gone_.y(), -depth), dt);
  touch.f = R * touch.f;
  touch.n = R * touch.n;
  return touch;
}

PhantomTouch PhantomFingersTwin::step(const Vec3& tip, double dt) {
  return stepAlone(one_, contacts_[0], tip, dt);
}

std::array<PhantomTouch, 2> PhantomFingersTwin::step(const std::array<Vec3, 2>& tips, double dt) {
  const Vec3 between(tips[0].x() - tips[1].x(), tips[0].y() - tips[1].y(), 0);
  const double distance = std::max(between.norm(), both_.apart / 2),
               share = both_.apart * both_.apart / (distance * distance);
  const PairCell more = both_.more(0, {depthOf(tips[0]), depthOf(tips[1])});
  std::array<PhantomTouch, 2> touches;
  for (std::size_t t = 0; t < 2; ++t)
    touches[t] =
        stepAlone(one_, contacts_[t], tips[t], dt,
                  share * (more.f[t].x() * between / distance + more.f[t].y() * Vec3::UnitZ()));
  return touches;
}

std::array<PhantomTouch, 2> PhantomPairTwin::step(const std::array<Vec3, 2>& tips, double dt) {
  constexpr double kLevel = 1e-6;  // m
  const Vec3 between = tips[0] - tips[1];
  if (std::abs(between.x() - both_.apart) > kLevel || std::abs(between.y()) > kLevel ||
      std::abs(tips[0].y()) > kLevel)
    throw Error("two tools on a simulated phantom must stay side by side over its middle",
                "phantom", "lead them so");
  const PairCell cell =
      both_.at(one_, 0.5 * (tips[0].x() + tips[1].x()), {depthOf(tips[0]), depthOf(tips[1])});
  std::array<PhantomTouch, 2> touches;
  for (std::size_t t = 0; t < 2; ++t) {
    touches[t] = contacts_[t].step(Vec3(cell.f[t].x(), 0, cell.f[t].y()), tips[t], dt);
    touches[t].lump = Vec3(cell.lump.x(), 0, cell.lump.y());
  }
  return touches;
}

}  // namespace palpa::twin
