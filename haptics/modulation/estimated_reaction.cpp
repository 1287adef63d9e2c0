#include "haptics/modulation/estimated_reaction.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

double squared(double v) { return v * v; }

Vec3 smoothed(const Vec3& p_M, double dt, EstimateState& state) noexcept {
  const double share = state.held ? dt / (kEstimateSmooth_s + dt) : 1;
  const Vec3 before = state.held ? unpack(state.p_M) : p_M;
  return before + share * (p_M - before);
}

/// Where the first tool's reaction has the face.
void learnLevel(const StiffnessModulation& law, double lowest, double x,
                EstimateState& state) noexcept {
  const double pressed = std::max(x - law.x0, 0.0),
               rise = std::max(stiffnessOf(law.real, pressed, 0), 1.0),
               precision = 1 / (squared(kEstimateForceDoubt / rise) +
                                squared(kEstimateDepthDoubt * pressed));
  state.precision += precision;
  state.level += (lowest + x - state.level) * precision / state.precision;
}

}  // namespace

EstimatedReaction estimateReaction(const std::array<StiffnessModulation, 2>& laws,
                                   const SecondFace& face, double tip_radius,
                                   const ToolTouch& first, const Vec3& p_M, double dt,
                                   EstimateState* state) noexcept {
  const StiffnessModulation &law = laws[0], &second = laws[1];
  const bool usable = p_M.allFinite() && dt > 0 && law.real.k > 0 && second.real.k > 0 &&
                      (!first.present || (first.p_M.allFinite() && first.f_r.allFinite()));
  if (!usable) {
    *state = {};
    return {};
  }
  if (!(state->precision > 0)) state->precision = 1 / squared(kFacePlacedWithin);
  EstimatedReaction told;
  told.p_M = smoothed(p_M, dt, *state);
  const Vec3 moved = state->held ? Vec3(told.p_M - unpack(state->p_M)) : Vec3(Vec3::Zero());
  state->p_M = pack(told.p_M);
  state->held = 1;
  const double f_1 = first.present ? first.f_r.z() : 0, lowest = first.p_M.z() - tip_radius;
  const bool touches = f_1 >= law.least_contact;
  const double x_1 = touches ? std::max(0.0, law.x0 + depthOf(law.real, f_1, 0)) : 0;
  if (face.opposed) {
    const double at_rest = face.thickness + told.p_M.z() + tip_radius;
    told.x = touches ? at_rest - lowest - x_1 : at_rest;
  } else {
    if (touches) learnLevel(law, lowest, x_1, *state);
    told.x = state->level - (told.p_M.z() - tip_radius);
  }
  told.x = std::max(told.x, 0.0);
  const double f_n = forceOf(second.real, told.x - second.x0, 0);
  if (!(f_n >= second.least_contact)) {
    state->friction = {};
    return told;
  }
  const Vec3 n = face.opposed ? Vec3(-Vec3::UnitZ()) : Vec3(Vec3::UnitZ());
  told.f_r = f_n * n - dragOf(second.friction, moved, n, f_n, dt, &state->friction);
  return told;
}

}  // namespace palpa::haptics
