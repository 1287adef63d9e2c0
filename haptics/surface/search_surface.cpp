#include "haptics/surface/search_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "anatomy/geometry/error.h"
#include "haptics/surface/closest_bump.h"

namespace palpa::haptics {
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
    middles[static_cast<std::size_t>(e)] = {spec.circle * std::cos(angle),
                                            spec.circle * std::sin(angle)};
  }
  return middles;
}

/// A trough around an element's middle, deepest at the radius `around`, for a point at (x, y, z) in
/// the element's frame: the nearest lies in the upright plane through the middle and the point.
void closestOnTrough(const TroughProfile& trough, double around, double x, double y, double z,
                     SurfacePoint* best) noexcept {
  const double r = std::sqrt(x * x + y * y);
  const double across = std::max(std::abs(r - around) - trough.halfWidth(), 0.0),
               under = std::max(-trough.depth() - z, 0.0);
  if (!(across * across + under * under < best->distance2)) return;
  const TroughProfile::Point p = trough.closestInside(r - around, z);
  if (!(p.distance2 < best->distance2)) return;
  const double to = around + p.s;
  *best = r > 0 ? SurfacePoint{x * to / r, y * to / r, p.z, p.distance2}
                : SurfacePoint{to, 0, p.z, p.distance2};
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
    SurfacePoint best{0, 0, 0, distance2};
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
