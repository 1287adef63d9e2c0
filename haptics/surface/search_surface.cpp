#include "haptics/surface/search_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "haptics/surface/bump_pattern.h"

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
  theta_ = pinned::asin(R / std::sqrt(w_ * w_ + up * up)) - pinned::atan2(up, w_);
  flank_ = std::sqrt(flank2);
  sin_ = pinned::sin(theta_);
  cos_ = pinned::cos(theta_);
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

namespace {

constexpr double kSkin = 1e-9;  // U: no deeper than this is on the surface
constexpr double kThirdOfATurn = 2.0943951023931953;

/// Written so that what is not a number is refused.
const SearchSpec& checkedFloor(const SearchSpec& spec, const SearchStimulus& stimulus) {
  const auto require = [](bool fits, const char* what, const char* remedy) {
    if (!fits) throw Error(what, "search floor", remedy);
  };
  const double outer = spec.groove + spec.groove_half_width;
  require(spec.pit > 0 && spec.pit < spec.disc, "the pit does not fit in the textured disc",
          "Make the pit's radius positive and smaller than the disc's");
  require(spec.groove_half_width > 0 && spec.groove - spec.groove_half_width >= spec.disc,
          "the groove runs into the textured disc",
          "Let it be deepest farther out, or make it narrower");
  require(std::sqrt(3.0) * spec.circle >= 2 * outer, "the elements overlap",
          "Put them on a wider circle");
  require(spec.circle + outer <= 0.5 * spec.side && std::isfinite(spec.side),
          "the elements do not fit on the floor", "Make its side longer");
  for (const BumpSpec* texture : {&spec.target, &spec.distractor})
    require(texture->inner >= spec.pit && texture->outer <= spec.disc,
            "a texture goes beyond its disc",
            "Let it begin outside of the pit and end within the disc");
  require(std::isfinite(stimulus.orientation), "the orientation is not a number",
          "Give an angle in radians");
  require(stimulus.target >= 0 && stimulus.target < SearchSurface::kElements,
          "there is no such element for the target", "Take 0, 1 or 2");
  return spec;
}

std::array<std::array<double, 2>, SearchSurface::kElements> middlesOf(const SearchSpec& spec,
                                                                      double orientation) {
  std::array<std::array<double, 2>, SearchSurface::kElements> middles;
  for (int e = 0; e < SearchSurface::kElements; ++e) {
    const double angle = orientation + e * kThirdOfATurn;
    middles[static_cast<std::size_t>(e)] = {spec.circle * pinned::cos(angle),
                                            spec.circle * pinned::sin(angle)};
  }
  return middles;
}

/// A trough around an element's middle, deepest at the radius `around`, for a point at (x, y, z) in
/// the element's frame: the nearest lies in the upright plane through the middle and the point.
void closestOnTrough(const TroughProfile& trough, double around, double x, double y, double z,
                     PatternPoint* best) noexcept {
  const double r = std::sqrt(x * x + y * y);
  const double across = std::max(std::abs(r - around) - trough.halfWidth(), 0.0),
               under = std::max(-trough.depth() - z, 0.0);
  if (!(across * across + under * under < best->distance2)) return;
  const TroughProfile::Point p = trough.closestInside(r - around, z);
  if (!(p.distance2 < best->distance2)) return;
  const double to = around + p.s;
  *best = r > 0 ? PatternPoint{x * to / r, y * to / r, p.z, p.distance2}
                : PatternPoint{to, 0, p.z, p.distance2};
}

}  // namespace

SearchSurface::SearchSurface(const SearchSpec& spec, const SearchStimulus& stimulus,
                             const std::function<double()>& uniform)
    : spec_(checkedFloor(spec, stimulus)),
      stimulus_(stimulus),
      groove_(spec.groove_half_width, spec.groove_depth, spec.bottom_radius, spec.lip_radius),
      pit_(spec.pit, spec.pit_depth, spec.bottom_radius, spec.lip_radius),
      target_(spec.target, uniform),
      distractor_(spec.distractor, uniform),
      middles_(middlesOf(spec, stimulus.orientation)) {}

std::array<double, 2> SearchSurface::middle(int element) const noexcept {
  return middles_[static_cast<std::size_t>(element)];
}

SearchSurface::Place SearchSurface::place(double x, double y) const noexcept {
  const double outer = spec_.groove + spec_.groove_half_width;
  Place place;
  for (int e = 0; e < kElements; ++e) {
    const auto [mx, my] = middles_[static_cast<std::size_t>(e)];
    const double dx = x - mx, dy = y - my, r2 = dx * dx + dy * dy;
    if (!(r2 < outer * outer)) continue;
    place.element = e;
    place.pit = r2 < spec_.pit * spec_.pit;
    place.texture = !place.pit && r2 <= spec_.disc * spec_.disc;
    place.x = dx;
    place.y = dy;
  }
  return place;
}

double SearchSurface::smoothHeight(double x, double y) const noexcept {
  return smoothHeight(place(x, y));
}

double SearchSurface::smoothHeight(const Place& at) const noexcept {
  if (at.element < 0 || at.texture) return 0;
  const double r = std::sqrt(at.x * at.x + at.y * at.y);
  return at.pit ? pit_.height(r) : groove_.height(r - spec_.groove);
}

double SearchSurface::height(double x, double y) const noexcept {
  const Place at = place(x, y);
  return at.texture ? texture(at.element).height(at.x, at.y) : smoothHeight(at);
}

Vec3 SearchSurface::normal(double x, double y) const noexcept {
  const Place at = place(x, y);
  if (at.element < 0) return Vec3::UnitZ();
  if (at.texture) {
    const BumpPattern::Bump* bump = texture(at.element).over(at.x, at.y);
    if (!bump) return Vec3::UnitZ();
    const double dx = at.x - bump->x, dy = at.y - bump->y, r = texture(at.element).spec().radius;
    return Vec3(dx, dy, std::sqrt(std::max(0.0, r * r - dx * dx - dy * dy))).normalized();
  }
  const double r = std::sqrt(at.x * at.x + at.y * at.y);
  if (r <= 0) return Vec3::UnitZ();
  const double slope = at.pit ? pit_.slope(r) : groove_.slope(r - spec_.groove);
  return Vec3(-slope * at.x / r, -slope * at.y / r, 1).normalized();
}

/// Of a point within the walls.
bool SearchSurface::overFloor(const Vec3& p) const noexcept {
  if (p.z() >= std::max(spec_.target.radius, spec_.distractor.radius)) return true;
  const Place at = place(p.x(), p.y());
  if (!(p.z() >= smoothHeight(at) - kSkin)) return false;
  if (!at.texture) return true;
  const BumpPattern::Bump* bump =
      texture(at.element).over(at.x, at.y);  // of equal balls the nearest across is the nearest
  if (!bump) return true;
  const double dx = at.x - bump->x, dy = at.y - bump->y,
               held = texture(at.element).spec().radius - kSkin;
  return dx * dx + dy * dy + p.z() * p.z() >= held * held;
}

bool SearchSurface::isFree(const Vec3& p) const noexcept {
  return std::abs(p.x()) <= 0.5 * spec_.side && std::abs(p.y()) <= 0.5 * spec_.side && overFloor(p);
}

Vec3 SearchSurface::closestFree(const Vec3& p) const noexcept {
  if (!p.allFinite()) return p;
  const double half = 0.5 * spec_.side;
  const Vec3 inside(std::clamp(p.x(), -half, half), std::clamp(p.y(), -half, half), p.z());
  return overFloor(inside) ? inside : closestOnFloor(inside);
}

/// Of a point in the solid. The level right above it where that is bare; the troughs; and where a
/// bump stands above it, the bumps, for elsewhere the level or a trough's rim is nearer than any of
/// them.
Vec3 SearchSurface::closestOnFloor(const Vec3& p) const noexcept {
  const Place at = place(p.x(), p.y());
  const bool covered = at.texture && texture(at.element).covered(at.x, at.y);
  Vec3 closest = p;
  double distance2 = std::numeric_limits<double>::infinity();
  if ((at.element < 0 || at.texture) && !covered) {
    closest.z() = 0;
    distance2 = p.z() * p.z();
  }
  for (int e = 0; e < kElements; ++e) {
    const auto [mx, my] = middles_[static_cast<std::size_t>(e)];
    PatternPoint best{0, 0, 0, distance2};
    const double x = p.x() - mx, y = p.y() - my;
    closestOnTrough(groove_, spec_.groove, x, y, p.z(), &best);
    closestOnTrough(pit_, 0, x, y, p.z(), &best);
    if (covered && e == at.element) closestOnBumps(texture(e), x, y, p.z(), &best);
    if (!(best.distance2 < distance2)) continue;
    closest = Vec3(mx + best.x, my + best.y, best.z);
    distance2 = best.distance2;
  }
  return closest;
}

int SearchSurface::bumpEntered(double ax, double ay, double bx, double by) const noexcept {
  const double dx = bx - ax, dy = by - ay, length2 = dx * dx + dy * dy;
  for (int e = 0; e < kElements; ++e) {
    const auto [mx, my] = middles_[static_cast<std::size_t>(e)];
    const double along =
        length2 > 0 ? std::clamp(((mx - ax) * dx + (my - ay) * dy) / length2, 0.0, 1.0) : 0;
    const double x = ax + along * dx - mx, y = ay + along * dy - my;
    if (x * x + y * y < spec_.disc * spec_.disc &&
        texture(e).entered(ax - mx, ay - my, bx - mx, by - my))
      return e;
  }
  return -1;
}

bool SearchSurface::crossesBump(double ax, double ay, double bx, double by) const noexcept {
  return bumpEntered(ax, ay, bx, by) >= 0;
}

double SearchSurface::bumpOnWay(double ax, double ay, double bx, double by) const noexcept {
  const Place at = place(bx, by);
  if (at.texture && texture(at.element).covered(at.x, at.y))
    return texture(at.element).spec().radius;
  const int entered = bumpEntered(ax, ay, bx, by);
  return entered < 0 ? 0 : texture(entered).spec().radius;
}

}  // namespace palpa::haptics
