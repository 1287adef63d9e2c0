#include "haptics/modulation/touch_augmentation.h"

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/top_shape.h"

namespace palpa::haptics {
namespace {

/// One tool on the real object; a tool that has just come has not moved yet.
Modulated feel(const TouchAugmentation& law, const ToolTouch& tool, double dt, std::size_t t,
               TouchAugmentationState* state) noexcept {
  if (!tool.present || !tool.p_M.allFinite()) {
    state->surface[t] = {};
    state->held[t] = 0;
    return {};
  }
  const Vec3 dp = state->held[t] ? Vec3(tool.p_M - unpack(state->p_before[t])) : Vec3(Vec3::Zero());
  state->p_before[t] = pack(tool.p_M);
  state->held[t] = 1;
  const StiffnessModulation here = lawAt(law.surface.contact, law.map, tool.p_M);
  if (law.other_friction) {
    const double factor = std::isfinite(tool.friction) && tool.friction >= 0 ? tool.friction : 1;
    FrictionModulation surface{here, law.surface.wanted};
    surface.wanted.mu *= factor;
    surface.wanted.B *= factor;
    return modulateFriction(surface, tool.f_r, dp, dt, &state->surface[t]);
  }
  return modulateStiffness(here, tool.f_r, dp, dt, &state->surface[t].contact);
}

/// In place of another stiffness and friction; what other lumps are put into is the object alone.
void takeAway(const TouchAugmentation& law, const PlacedLumps& lumps,
              const std::array<TouchAboveLumps, 2>& tools, double dt, TakenState* state,
              std::array<InclusionContact, 2>* contacts, AugmentedTouch* now) noexcept {
  const TakenLumps taken = takeLumps({lawAt(law.surface.contact, law.map, tools[0].p_M),
                                      lawAt(law.surface.contact, law.map, tools[1].p_M)},
                                     law.kinds, lumps, law.tip_radius, tools, dt, state);
  now->d = taken.d;
  now->iterations += taken.iterations;
  now->f_d = now->f_taken = taken.f_d;
  now->taking = 1;
  for (std::size_t t = 0; t < 2; ++t) {
    if (!taken.contacts[t].touching) continue;
    (*contacts)[t] = taken.contacts[t];
    now->touch[t].x = taken.contacts[t].x;
  }
}

/// In the frame at its place in which the normal over it is z.
InclusionAnswer feelTilted(const VirtualInclusion& law, const PlacedLump& lump,
                           const std::array<InclusionContact, 2>& contacts, double dt,
                           InclusionState* state) noexcept {
  const Vec3 p_T0 = unpack(lump.p_T0), n = outwardOver(lump);
  if (n == Vec3::UnitZ()) return feelInclusion(law, p_T0, contacts, dt, state);
  const Mat3 R = turnToNormal(n);
  std::array<InclusionContact, 2> own = contacts;
  for (InclusionContact& contact : own) {
    contact.p_H = R.transpose() * (contact.p_H - p_T0);
    contact.u_n = R.transpose() * contact.u_n;
  }
  InclusionAnswer answer = feelInclusion(law, Vec3::Zero(), own, dt, state);
  for (Vec3& f : answer.f_T) f = R * f;
  return answer;
}

}  // namespace

Vec3 outwardOver(const PlacedLump& lump) noexcept {
  const Vec3 n = Eigen::Vector3f(lump.n[0], lump.n[1], lump.n[2]).cast<double>();
  const double length = n.norm();
  return length > 0.5 && length < 2 && n.z() > 0 ? Vec3(n / length) : Vec3(Vec3::UnitZ());
}

AugmentedTouch augmentTouch(const TouchAugmentation& law, const PlacedLumps& lumps,
                            const std::array<ToolTouch, 2>& tools, double dt,
                            TouchAugmentationState* state) noexcept {
  AugmentedTouch now;
  std::array<InclusionContact, 2> contacts;
  std::array<TouchAboveLumps, 2> above;
  for (std::size_t t = 0; t < 2; ++t) {
    above[t] = {tools[t].present, tools[t].p_M, Vec3::Zero(), tools[t].f_r};
    if (state->held[t]) above[t].dp = tools[t].p_M - unpack(state->p_before[t]);
    now.touch[t] = feel(law, tools[t], dt, t, state);
    const Modulated& touch = now.touch[t];
    now.f_source[t] = textureForce(law.texture, touch.contact ? touch.f_n : 0, touch.slid, dt,
                                   &state->texture[t]) *
                      touch.u_n;
    now.f_d[t] = touch.f_d;
    contacts[t] = {touch.contact, Vec3(tools[t].p_M - law.tip_radius * touch.u_n), touch.u_n,
                   touch.x, law.tip_radius};
  }
  if (std::any_of(lumps.begin(), lumps.end(), isTaken))
    takeAway(law, lumps, above, dt, &state->taken, &contacts, &now);
  else
    state->taken = {};
  for (std::size_t t = 0; t < 2; ++t) now.f_d[t] += now.f_source[t];
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    if (lumps[i].kind == 0 || lumps[i].kind > law.kinds.size() || lumps[i].taken > 0) {
      state->lumps[i] = {};
      continue;
    }
    const InclusionAnswer lump =
        feelTilted(law.kinds[lumps[i].kind - 1], lumps[i], contacts, dt, &state->lumps[i]);
    now.d[i] = pack(lump.d);
    now.iterations += lump.iterations;
    for (std::size_t t = 0; t < 2; ++t) {
      const Modulated& felt = now.touch[t];
      if (!felt.contact) continue;
      const Vec3 f = lump.f_T[t] + rubbedByLump(lump.f_T[t], tools[t].f_r - felt.f_n * felt.u_n,
                                                felt.f_n, felt.u_n);
      now.f_d[t] += f;
      now.f_lumps[t] += f;
    }
  }
  return now;
}

}  // namespace palpa::haptics
