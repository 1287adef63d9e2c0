#include "haptics/surface/trough_profile.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "anatomy/geometry/error.h"

namespace palpa::haptics {
namespace {

constexpr double kClosure = 1e-9;  // of the half width: arcs and flank have to end at the level

void keepNearer(double s, double z, double to_s, double to_z, TroughProfile::Point* best) noexcept {
  const double ds = to_s - s, dz = to_z - z, d2 = ds * ds + dz * dz;
  if (d2 < best->distance2) *best = {to_s, to_z, d2};
}

}  // namespace

TroughProfile::TroughProfile(double half_width, double depth, double bottom_radius,
                             double lip_radius)
    : w_(half_width), depth_(depth), r_b_(bottom_radius), r_l_(lip_radius) {
  const double R = r_b_ + r_l_, up = R - depth_, flank2 = w_ * w_ + up * up - R * R;
  theta_ = std::asin(R / std::sqrt(w_ * w_ + up * up)) - std::atan2(up, w_);
  flank_ = std::sqrt(flank2);
  sin_ = std::sin(theta_);
  cos_ = std::cos(theta_);
  s_bottom_ = r_b_ * sin_;
  s_lip_ = w_ - r_l_ * sin_;
  const bool sizes = w_ > 0 && depth_ > 0 && r_b_ > 0 && r_l_ > 0 && flank2 >= 0;
  // The angle is one of two whose sine is the same: only the one that ends at the level is meant.
  const bool closes = std::abs(R * sin_ + flank_ * cos_ - w_) <= kClosure * w_ &&
                      std::abs(R * (1 - cos_) + flank_ * sin_ - depth_) <= kClosure * w_;
  if (!(sizes && theta_ > 0 && cos_ > 0 && closes))
    throw Error("no two arcs with radii " + std::to_string(r_b_) + " and " + std::to_string(r_l_) +
                    " fit a trough of half width " + std::to_string(w_) + " and depth " +
                    std::to_string(depth_),
                "trough", "Make it wider, less deep, or its arcs smaller");
}

double TroughProfile::height(double s) const noexcept {
  const double a = std::abs(s);
  if (a >= w_) return 0;
  if (a <= s_bottom_) return -depth_ + r_b_ - std::sqrt(r_b_ * r_b_ - a * a);
  if (a < s_lip_) return -depth_ + r_b_ * (1 - cos_) + (a - s_bottom_) * sin_ / cos_;
  return std::sqrt(r_l_ * r_l_ - (w_ - a) * (w_ - a)) - r_l_;
}

double TroughProfile::slope(double s) const noexcept {
  const double a = std::abs(s), side = s < 0 ? -1 : 1;
  if (a >= w_) return 0;
  if (a <= s_bottom_) return s / std::sqrt(r_b_ * r_b_ - a * a);
  if (a < s_lip_) return side * sin_ / cos_;
  return side * (w_ - a) / std::sqrt(r_l_ * r_l_ - (w_ - a) * (w_ - a));
}

/// The nearer side's arcs, where the point lies within their angle, and the flank with its ends;
/// the other side is never nearer.
TroughProfile::Point TroughProfile::closestInside(double s, double z) const noexcept {
  const double a = std::abs(s);
  Point best{w_, 0, (w_ - a) * (w_ - a) + z * z};
  const double down = r_b_ - depth_ - z;  // below the middle of the bottom's arc
  if (const double n = std::sqrt(a * a + down * down); down >= 0 && a * cos_ <= down * sin_) {
    const double to_s = n > 0 ? r_b_ * a / n : 0, to_z = n > 0 ? r_b_ * down / n : r_b_;
    keepNearer(a, z, to_s, r_b_ - depth_ - to_z, &best);
  }
  const double z_bottom = r_b_ * (1 - cos_) - depth_;
  const double along = std::clamp((a - s_bottom_) * cos_ + (z - z_bottom) * sin_, 0.0, flank_);
  keepNearer(a, z, s_bottom_ + along * cos_, z_bottom + along * sin_, &best);
  const double in = w_ - a, up = z + r_l_;  // from the middle of the lip's arc
  if (const double n = std::sqrt(in * in + up * up);
      in >= 0 && n > 0 && up > 0 && in * cos_ <= up * sin_)
    keepNearer(a, z, w_ - r_l_ * in / n, r_l_ * up / n - r_l_, &best);
  if (s < 0) best.s = -best.s;
  return best;
}

TroughProfile::Point TroughProfile::closest(double s, double z) const noexcept {
  Point best = closestInside(s, z);
  if (std::abs(s) >= w_ && z * z < best.distance2) best = {s, 0, z * z};
  return best;
}

}  // namespace palpa::haptics
