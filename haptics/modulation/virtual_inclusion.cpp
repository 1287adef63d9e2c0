#include "haptics/modulation/virtual_inclusion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

constexpr double kLumpBalanced = 1e-6;  // N
constexpr double kNearestToLump =
    1e-4;  // m between tool and lump: nearer there is no line between them
constexpr double kBedFloor =
    1e-5;  // m: below, a bed's stiffness is taken from there, for at rest it may be zero
constexpr int kMostHalvings = 8;

/// x^(m - 1) at kBedFloor: of the beds of a lump that hardly moves, one power for all.
class PowerAtFloor {
 public:
  double of(double m) noexcept {
    if (m != m_) power_ = pinned::pow(kBedFloor, m - 1);
    m_ = m;
    return power_;
  }

 private:
  double m_ = std::numeric_limits<double>::quiet_NaN(), power_ = 0;  // of none yet
};

/// A law with its rate as a backward difference from `before`: force, and its derivative by the
/// depth.
struct Implicit {
  double f = 0, slope = 0;
};
Implicit implicitly(const HuntCrossley& law, double x, double before, double dt,
                    PowerAtFloor* at_floor) noexcept {
  const double rate = (x - before) / dt, factor = law.k + law.b * rate,
               least = 0.1 * law.k;  // as forceOf and stiffnessOf have it, with one power for all
  const double at = std::max(x, kBedFloor);
  const double power = x > kBedFloor ? pinned::pow(x, law.m - 1) : at_floor->of(law.m);
  const double held = std::max(factor, least);
  Implicit i;
  i.f = x == at ? power * at * held : forceOf(law, x, rate);
  i.slope = power * (law.m * held + (factor < least ? 0 : at * law.b / dt));
  return i;
}

/// The lump pushed by d: what the tools feel, what is left unbalanced on it, and how that changes
/// with d.
struct Balance {
  std::array<Vec3, 2> f_T{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> l{};
  Vec3 left = Vec3::Zero();
  Mat3 slope = Mat3::Zero();
};

class InclusionForces {
 public:
  InclusionForces(const VirtualInclusion& lump, const Vec3& p_T0,
                  const std::array<InclusionContact, 2>& tools, double dt,
                  const InclusionState& before) noexcept
      : lump_(lump),
        p_T0_(p_T0),
        tools_(tools),
        dt_(dt),
        d_before_(unpack(before.d)),
        l_before_(before.l) {
    for (std::size_t t = 0; t < 2; ++t)
      from_surface_[t] = (tools[t].p_H + tools[t].x * tools[t].u_n - p_T0).norm();
  }

  Balance at(const Vec3& d) noexcept {
    Balance b;
    for (int i = 0; i < 3; ++i) {
      const double side = d[i] < 0 ? -1 : 1;
      const Implicit bed = implicitly(lump_.G[static_cast<std::size_t>(i)], side * d[i],
                                      side * d_before_[i], dt_, &at_floor_);
      b.left[i] = side * bed.f;
      b.slope(i, i) = bed.slope;
    }
    for (std::size_t t = 0; t < 2; ++t) addTool(t, d, &b);
    return b;
  }

 private:
  void addTool(std::size_t t, const Vec3& d, Balance* b) noexcept {
    const Vec3 line = tools_[t].p_H - (p_T0_ + d);
    const double apart = line.norm();
    if (!tools_[t].touching || apart < kNearestToLump || from_surface_[t] < kNearestToLump) return;
    const double scale = lump_.l0 / from_surface_[t];
    b->l[t] = std::max(scale * (from_surface_[t] - apart), 0.0);
    if (b->l[t] <= 0) return;
    Implicit felt = implicitly(lump_.H_T, b->l[t], l_before_[t], dt_, &at_floor_);
    if (lump_.falls != 0) {
      const double share = pinned::pow(scale, lump_.falls);
      felt.f *= share;
      felt.slope *= share;
    }
    const Vec3 to_middle = line + tools_[t].radius * tools_[t].u_n;
    const double from_middle = std::max(to_middle.norm(), kNearestToLump);
    const Vec3 n = to_middle / from_middle;
    b->f_T[t] = felt.f * n;
    b->left += b->f_T[t];
    b->slope += scale * felt.slope * n * (line / apart).transpose() -
                felt.f / from_middle * (Mat3::Identity() - n * n.transpose());
  }

  const VirtualInclusion& lump_;
  Vec3 p_T0_;
  const std::array<InclusionContact, 2>& tools_;
  double dt_;
  Vec3 d_before_;
  std::array<double, 2> l_before_;
  std::array<double, 2> from_surface_{};
  PowerAtFloor at_floor_;
};

bool usable(const Vec3& p_T0, const std::array<InclusionContact, 2>& tools, double dt,
            const InclusionState& state) noexcept {
  bool good = dt > 0 && p_T0.allFinite() && unpack(state.d).allFinite();
  for (const InclusionContact& tool : tools)
    good = good && (!tool.touching ||
                    (tool.p_H.allFinite() && tool.u_n.allFinite() && std::isfinite(tool.x)));
  return good;
}

}  // namespace

InclusionAnswer feelInclusion(const VirtualInclusion& lump, const Vec3& p_T0,
                              const std::array<InclusionContact, 2>& tools, double dt,
                              InclusionState* state) noexcept {
  InclusionAnswer answer;
  if (!usable(p_T0, tools, dt, *state)) {
    *state = {};
    return answer;
  }
  InclusionForces problem(lump, p_T0, tools, dt, *state);
  Vec3 d = unpack(state->d);
  Balance now = problem.at(d);
  while (now.left.norm() > kLumpBalanced && answer.iterations < kMostInclusionIterations) {
    ++answer.iterations;
    Vec3 step = -(now.slope.inverse() * now.left);
    if (!step.allFinite()) break;
    Balance next = problem.at(d + step);
    for (int i = 0; i < kMostHalvings && !(next.left.norm() < now.left.norm()); ++i) {
      step *= 0.5;
      next = problem.at(d + step);
    }
    if (!(next.left.norm() < now.left.norm())) break;
    d += step;
    now = next;
  }
  answer.f_T = now.f_T;
  answer.d = d;
  answer.unbalanced = now.left.norm();
  state->d = pack(d);
  state->l = now.l;
  return answer;
}

Vec3 rubbedByLump(const Vec3& f_T, const Vec3& f_t, double f_n, const Vec3& u_n) noexcept {
  const double share = f_n > 0 ? f_T.dot(u_n) / f_n : 0;
  const Vec3 f = share * f_t;
  return f.allFinite() ? f : Vec3(Vec3::Zero());
}

}  // namespace palpa::haptics
