#include "haptics/surface/bump_pattern.h"

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/error.h"

namespace palpa::haptics {
namespace {

constexpr double kMostCells = 4096;  // along a side: more is no texture that anybody feels
constexpr double kTouching =
    1 - 2e-12;  // of the radius squared: nearer to an edge than this a way has only touched it

/// Written so that what is not a number is refused.
void checkBumps(const BumpSpec& spec) {
  const bool sizes = spec.radius > 0 && spec.spacing > 0 && spec.jitter >= 0 && spec.inner >= 0 &&
                     std::isfinite(spec.jitter);
  const bool room = spec.outer - spec.inner >= 2 * spec.radius;
  const bool cells = 2 * spec.outer / spec.spacing <= kMostCells;
  if (!(sizes && room && cells && std::isfinite(spec.outer) && std::isfinite(spec.spacing)))
    throw Error(
        "a texture of hemispheres cannot have these figures", "bump pattern",
        "Radius and spacing must be positive, jitter and inner rim not negative, a hemisphere must "
        "fit between the rims, and at most 4096 cells across the outer one");
}

}  // namespace

BumpPattern::BumpPattern(const BumpSpec& spec, const std::function<double()>& uniform)
    : spec_(spec) {
  checkBumps(spec);
  side_ = std::max(1, static_cast<int>(std::ceil(2 * spec.outer / spec.spacing)));
  index_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), -1);
  for (int j = 0; j < side_; ++j)
    for (int i = 0; i < side_; ++i) {
      const double u1 = uniform(), u2 = uniform();
      const Bump bump{(i + 0.5 - 0.5 * side_) * spec.spacing + (u1 - 0.5) * spec.jitter,
                      (j + 0.5 - 0.5 * side_) * spec.spacing + (u2 - 0.5) * spec.jitter};
      const double from_middle = std::sqrt(bump.x * bump.x + bump.y * bump.y);
      if (!(from_middle - spec.radius >= spec.inner && from_middle + spec.radius <= spec.outer))
        continue;
      index_[static_cast<std::size_t>(j * side_ + i)] = static_cast<int>(bumps_.size());
      bumps_.push_back(bump);
    }
}

int BumpPattern::cell(double x) const noexcept {
  const double at = x / spec_.spacing + 0.5 * side_;
  if (!(at > 0)) return 0;
  return at < side_ ? static_cast<int>(at) : side_ - 1;
}

const BumpPattern::Bump* BumpPattern::over(double x, double y) const noexcept {
  const Bump* highest = nullptr;
  double nearest2 = spec_.radius * spec_.radius;
  near(x, y, spec_.radius, [&](const Bump& bump) {
    const double d2 = (x - bump.x) * (x - bump.x) + (y - bump.y) * (y - bump.y);
    if (d2 > nearest2) return;
    nearest2 = d2;
    highest = &bump;
  });
  return highest;
}

double BumpPattern::height(double x, double y) const noexcept {
  const Bump* bump = over(x, y);
  if (!bump) return 0;
  const double dx = x - bump->x, dy = y - bump->y;
  return std::sqrt(std::max(0.0, spec_.radius * spec_.radius - dx * dx - dy * dy));
}

bool BumpPattern::covered(double x, double y) const noexcept {
  const Bump* bump = over(x, y);
  if (!bump) return false;
  const double dx = x - bump->x, dy = y - bump->y;
  return dx * dx + dy * dy < spec_.radius * spec_.radius;
}

bool BumpPattern::entered(double ax, double ay, double bx, double by) const noexcept {
  const double dx = bx - ax, dy = by - ay, length2 = dx * dx + dy * dy;
  const double within2 = kTouching * spec_.radius * spec_.radius;
  const auto inside = [within2](double x, double y) { return x * x + y * y < within2; };
  bool any = false;
  near(ax + 0.5 * dx, ay + 0.5 * dy, 0.5 * std::sqrt(length2) + spec_.radius,
       [&](const Bump& bump) {
         const double x = ax - bump.x, y = ay - bump.y;
         if (any || inside(x, y)) return;
         // b is judged just as the next way's a will be, so that none is counted twice and none is
         // lost.
         if (inside(bx - bump.x, by - bump.y)) {
           any = true;
           return;
         }
         const double along =
             -(x * dx + y * dy);  // to where the way is nearest to the bump's middle
         if (along > 0 && along < length2)
           any = inside(x + along / length2 * dx, y + along / length2 * dy);
       });
  return any;
}

}  // namespace palpa::haptics
