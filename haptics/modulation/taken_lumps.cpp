#include "haptics/modulation/taken_lumps.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

constexpr double kSolvedWithin = 1e-4;  // N
constexpr double kFullFrom = 0.5;       // of the reaction, that the lumps add [chosen]
constexpr double kFalls = 1;

/// As it is taken off.
VirtualInclusion falling(VirtualInclusion lump) noexcept {
  lump.falls = kFalls;
  return lump;
}

/// The lumps that are taken off, under tools whose depths without them are sought.
class LumpsUnder {
 public:
  LumpsUnder(const std::array<VirtualInclusion, kMostLumpKinds>& kinds, const PlacedLumps& lumps,
             double dt, const std::array<InclusionState, kMostLumps>& before) noexcept
      : kinds_(kinds), lumps_(lumps), dt_(dt), before_(before) {}

  /// N along z on tool `t`, of all of them, if this tick ended so.
  double on(std::size_t t, const std::array<InclusionContact, 2>& contacts) noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < lumps_.size(); ++i) {
      if (!isTaken(lumps_[i])) continue;
      InclusionState tried = before_[i];
      const InclusionAnswer answer = feelInclusion(falling(kinds_[lumps_[i].kind - 1]),
                                                   unpack(lumps_[i].p_T0), contacts, dt_, &tried);
      sum += answer.f_T[t].z();
      iterations_ += answer.iterations;
    }
    return sum;
  }
  int iterations() const noexcept { return iterations_; }

 private:
  const std::array<VirtualInclusion, kMostLumpKinds>& kinds_;
  const PlacedLumps& lumps_;
  double dt_;
  const std::array<InclusionState, kMostLumps>& before_;
  int iterations_ = 0;
};

double rateOf(const TouchAboveLumps& tool, double dt) noexcept { return -tool.dp.z() / dt; }

bool usable(const StiffnessModulation& surface, const TouchAboveLumps& tool, double dt) noexcept {
  return tool.touching && dt > 0 && tool.p_M.allFinite() && tool.dp.allFinite() &&
         tool.f_r.allFinite() && tool.f_r.z() >= surface.least_contact;
}

/// N: what the object and the lumps would give more than is sensed, were it x deep.
template <typename At>
void solveDepth(double sensed, double whole, At more) noexcept {
  double low = 0, high = whole, at_low = -sensed, at_high = more(high);
  for (int i = 0; i < kMostPlainIterations && at_high > kSolvedWithin; ++i) {
    const double secant = low + (high - low) * at_low / (at_low - at_high);
    const double next = i % 4 == 3 || !std::isfinite(secant) ? 0.5 * (low + high) : secant;
    const double at = more(next);
    if (std::abs(at) < kSolvedWithin) return;
    if (at < 0) {
      low = next;
      at_low = at;
      at_high *= 0.5;  // Illinois: or one end would stay
    } else {
      high = next;
      at_high = at;
      at_low *= 0.5;
    }
  }
}

double largestShare(const PlacedLumps& lumps) noexcept {
  double most = 0;
  for (const PlacedLump& lump : lumps)
    if (isTaken(lump)) most = std::max(most, static_cast<double>(lump.taken));
  return most;
}

/// All that is taken of one tool's reaction; `H`: N, what the object alone gives back along z.
Vec3 takenOf(const StiffnessModulation& surface, const TouchAboveLumps& tool, double H, double dt,
             DahlState* friction) noexcept {
  const Vec3 up = Vec3::UnitZ();
  const double sensed = tool.f_r.z(), added = std::max(sensed - H, 0.0);
  const Vec3 drag = dragOf(surface.friction, slidOver(tool.dp, up, sensed), up, H, dt, friction);
  Vec3 across = -drag - (tool.f_r - sensed * up);
  // A tip that leaps has no friction that a law could tell: no more than is sensed is put there.
  if (const double most = tool.f_r.norm(), size = across.norm(); size > most) across *= most / size;
  return (H - sensed) * up + std::min(1.0, added / (kFullFrom * sensed)) * across;
}

}  // namespace

bool isTaken(const PlacedLump& lump) noexcept {
  return lump.kind >= 1 && lump.kind <= kMostLumpKinds && lump.taken > 0 && lump.taken <= 1;
}

TakenLumps takeLumps(const std::array<StiffnessModulation, 2>& surfaces,
                     const std::array<VirtualInclusion, kMostLumpKinds>& kinds,
                     const PlacedLumps& lumps, double tip_radius,
                     const std::array<TouchAboveLumps, 2>& tools, double dt,
                     TakenState* state) noexcept {
  TakenLumps now;
  LumpsUnder under(kinds, lumps, dt, state->lumps);
  const auto contactAt = [&](std::size_t t, double x) {
    return InclusionContact{true, Vec3(tools[t].p_M - tip_radius * Vec3::UnitZ()), Vec3::UnitZ(), x,
                            tip_radius};
  };
  std::array<double, 2> whole{}, H{};
  for (std::size_t t = 0; t < 2; ++t) {
    if (!usable(surfaces[t], tools[t], dt)) {
      state->friction[t] = {};
      continue;
    }
    whole[t] = surfaces[t].x0 + depthOf(surfaces[t].real, tools[t].f_r.z(), rateOf(tools[t], dt));
    now.contacts[t] = contactAt(t, std::max(whole[t], 0.0));
  }
  const double share = largestShare(lumps);
  for (std::size_t t = 0; t < 2; ++t) {
    if (!now.contacts[t].touching) continue;
    const double sensed = tools[t].f_r.z();
    H[t] = sensed;
    if (whole[t] > 0)
      solveDepth(sensed, whole[t], [&](double x) {
        now.contacts[t] = contactAt(t, x);
        const double lump = under.on(t, now.contacts);
        H[t] = std::clamp(sensed - lump, 0.0, sensed);
        return forceOf(surfaces[t].real, x - surfaces[t].x0, rateOf(tools[t], dt)) + lump - sensed;
      });
    now.f_d[t] = share * takenOf(surfaces[t], tools[t], H[t], dt, &state->friction[t]);
  }
  now.iterations = under.iterations();
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    if (!isTaken(lumps[i])) {
      state->lumps[i] = {};
      continue;
    }
    const InclusionAnswer lump =
        feelInclusion(falling(kinds[lumps[i].kind - 1]), unpack(lumps[i].p_T0), now.contacts, dt,
                      &state->lumps[i]);
    now.d[i] = pack(lump.d);
  }
  return now;
}

double steepestRise(VirtualInclusion lump, double tip_radius, double deep) noexcept {
  lump.falls = kFalls;
  constexpr int kSteps = 200;
  constexpr double kSlow = 1;  // s a step: no rate matters
  InclusionState state;
  double steepest = 0, before = 0;
  const double step = deep / kSteps;
  for (int i = 1; i <= kSteps; ++i) {
    const double x = i * step;
    const InclusionContact contact{true, Vec3(0, 0, -x), Vec3::UnitZ(), x, tip_radius};
    const double f =
        feelInclusion(lump, Vec3(0, 0, -lump.l0), {contact, {}}, kSlow, &state).f_T[0].z();
    steepest = std::max(steepest, (f - before) / step);
    before = f;
  }
  return steepest;
}

}  // namespace palpa::haptics
