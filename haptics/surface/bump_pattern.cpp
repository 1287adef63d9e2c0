#include "haptics/surface/bump_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "anatomy/base/error.h"

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

namespace {

constexpr int kMostBalls = 24;
constexpr double kHolds = 1e-10;  // U: what is on a sphere, to rounding, is not in it
constexpr double kSameBall =
    1e-9;  // U: middles as near as this have no circle in common that could be told
constexpr std::array<double, 2> kLooks{3,
                                       5};  // radii. The second only where nothing is bare within 2
                                            // radii: not in a pattern of the search task

/// The balls around p, in a frame with its origin at p's (x, y): nothing in here depends on where
/// on the disc that is.
class Balls {
 public:
  Balls(const BumpPattern& pattern, double x, double y, double z, double reach) noexcept
      : radius_(pattern.spec().radius),
        r2_(radius_ * radius_),
        x_(x),
        y_(y),
        z_(z),
        complete2_(reach * reach) {
    pattern.near(x, y, reach,
                 [this](const BumpPattern::Bump& bump) { insert(bump.x - x_, bump.y - y_); });
    const double within = std::sqrt(complete2_) - radius_;
    within2_ = within > 0 ? within * within : -1;
  }

  void improve(PatternPoint* best) const noexcept {
    for (int i = 0; i < count_; ++i) {
      if (z_ >= 0) onSphere(at(i), best);
      onFootprint(at(i), best);
    }
    for (int i = 0; i < count_; ++i)
      for (int j = i + 1; j < count_; ++j) betweenTwo(i, j, best);
  }

  /// Whether nothing farther across the disc than what was looked at can be nearer: all of the
  /// bumps is at z >= 0.
  bool decide(const PatternPoint& best) const noexcept {
    const double below = std::min(z_, 0.0);
    return best.distance2 - below * below <= within2_;
  }

 private:
  struct BumpBall {
    double x = 0, y = 0, far2 = 0;
  };

  const BumpBall& at(int i) const noexcept { return balls_[static_cast<std::size_t>(i)]; }
  BumpBall& at(int i) noexcept { return balls_[static_cast<std::size_t>(i)]; }

  /// Nearest first. Where there are too many the farthest falls out, and only what is nearer than
  /// that is known completely.
  void insert(double x, double y) noexcept {
    const BumpBall ball{x, y, x * x + y * y};
    if (ball.far2 > complete2_) return;
    if (count_ == kMostBalls) {
      complete2_ = std::max(ball.far2, at(count_ - 1).far2);
      if (ball.far2 >= at(count_ - 1).far2) return;
      --count_;
    }
    int k = count_++;
    for (; k > 0 && at(k - 1).far2 > ball.far2; --k) at(k) = at(k - 1);
    at(k) = ball;
  }

  void offer(double x, double y, double z, PatternPoint* best) const noexcept {
    const double across2 = x * x + y * y, distance2 = across2 + (z - z_) * (z - z_);
    if (!(distance2 < best->distance2) || across2 > within2_) return;
    const double holds2 = (radius_ - kHolds) * (radius_ - kHolds);
    for (int i = 0; i < count_; ++i) {
      const double dx = x - at(i).x, dy = y - at(i).y;
      if (dx * dx + dy * dy + z * z < holds2) return;
    }
    *best = {x_ + x, y_ + y, z, distance2};
  }

  void onSphere(const BumpBall& ball, PatternPoint* best) const noexcept {
    const double n2 = ball.far2 + z_ * z_;
    if (n2 >= r2_) return;
    if (n2 <= 0) return offer(ball.x, ball.y, radius_, best);  // from the middle all are as near
    const double stretch = radius_ / std::sqrt(n2);
    offer(ball.x - stretch * ball.x, ball.y - stretch * ball.y, stretch * z_, best);
  }

  void onFootprint(const BumpBall& ball, PatternPoint* best) const noexcept {
    if (ball.far2 <= 0) return offer(ball.x + radius_, ball.y, 0, best);
    const double stretch = radius_ / std::sqrt(ball.far2);
    offer(ball.x - stretch * ball.x, ball.y - stretch * ball.y, 0, best);
  }

  void betweenTwo(int i, int j, PatternPoint* best) const noexcept {
    const double dx = at(j).x - at(i).x, dy = at(j).y - at(i).y, d2 = dx * dx + dy * dy;
    if (d2 >= 4 * r2_ || d2 < kSameBall * kSameBall) return;
    const double mx = 0.5 * (at(i).x + at(j).x),
                 my = 0.5 * (at(i).y + at(j).y);  // of their circle, which stands upright
    const double d = std::sqrt(d2), rho = std::sqrt(r2_ - 0.25 * d2), ux = -dy / d, uy = dx / d;
    offer(mx + rho * ux, my + rho * uy, 0, best);
    offer(mx - rho * ux, my - rho * uy, 0, best);
    if (z_ >= 0) {
      const double t = -(mx * ux + my * uy), n = std::sqrt(t * t + z_ * z_);
      const double across = n > 0 ? rho * t / n : 0;
      offer(mx + across * ux, my + across * uy, n > 0 ? rho * z_ / n : rho, best);
    }
    for (int k = j + 1; k < count_; ++k) amongThree(at(i), dx, dy, d2, at(k), best);
  }

  /// Three equal spheres around points of one plane meet over the middle of those points' circle.
  /// (dx, dy): from the first to the second.
  void amongThree(const BumpBall& a, double dx, double dy, double d2, const BumpBall& c,
                  PatternPoint* best) const noexcept {
    const double ex = c.x - a.x, ey = c.y - a.y, e2 = ex * ex + ey * ey,
                 area = 2 * (dx * ey - dy * ex);
    if (e2 >= 4 * r2_) return;
    const double x = (ey * d2 - dy * e2) / area, y = (dx * e2 - ex * d2) / area;
    const double z2 = r2_ - x * x - y * y;
    if (z2 > 0) offer(a.x + x, a.y + y, std::sqrt(z2), best);  // false for what lies on one line
  }

  const double radius_, r2_, x_, y_, z_;
  double complete2_, within2_ = 0;
  std::array<BumpBall, kMostBalls> balls_;
  int count_ = 0;
};

}  // namespace

void closestOnBumps(const BumpPattern& pattern, double x, double y, double z,
                    PatternPoint* best) noexcept {
  for (const double look : kLooks) {
    const Balls balls(pattern, x, y, z, look * pattern.spec().radius);
    balls.improve(best);
    if (balls.decide(*best)) return;
  }
}

}  // namespace palpa::haptics
