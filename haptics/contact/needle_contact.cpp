#include "haptics/contact/needle_contact.h"

#include <algorithm>

#include "anatomy/base/pinned_math.h"
#include "haptics/contact/needle_materials.h"

namespace palpa::haptics {
namespace {

constexpr double kSteepest = 0.1;  // least cosine between needle and skin normal that is believed
constexpr double kLeftSkin = 0.0005;  // m outside before the needle counts as withdrawn
constexpr double kTornOut =
    0.005;  // m that skin follows a point at most (a tent): beyond, it holds no needle
constexpr double kLateralRamp = 0.002;  // m of insertion over which the lateral hold builds up
constexpr double kStickShare = 0.8;     // presliding stiffness as a share of the coupling's

/// Right of the root below, however deep the tip is: for u >= u_f = max(u_0, 10 um),
/// F(u) >= K_0 (exp(m (u - u_0)) - 1) u_f, which reaches K_c x at the returned u.
double firstIndentation(const SkinLaw& skin, double K_c, double x) {
  const double floor = std::max(skin.u_0, 1e-5), slope = skin.K_0 * floor;
  if (!(slope > 0 && skin.m > 0)) return x;
  return std::min(x, std::max(floor, skin.u_0 + pinned::log1p(K_c * x / slope) / skin.m));
}

/// Indentation u of the skin with F(u) = K_c (x - u), x the tip's depth: the skin's law in series
/// with the coupling. The left side minus the right is convex and rising, so Newton from the right
/// descends to the root.
double indentationInSeries(const SkinLaw& skin, double K_c, double x) {
  double u = firstIndentation(skin, K_c, x);
  for (int i = 0; i < 60; ++i) {
    const double residual = skin.force(u) - K_c * (x - u);
    const double next = std::max(0.0, u - residual / (skin.stiffness(u) + K_c));
    if (u - next < 1e-12) return next;
    u = next;
  }
  return u;
}

struct NeedleTick {
  const NeedleMaterials& materials;
  const CouplingLimits& coupling;
  const LocalGeometry& geometry;
  const NeedlePose& pose;
  const TickCommands& commands;
  double dt;
  NeedleState& state;
  NeedleContact out;

  void push(const Vec3& f, const Vec3& p) {
    out.f_D += f;
    out.tau_D += (p - pose.p_DE).cross(f);
  }
};

void decayRelease(NeedleTick& s) {
  const double keep = pinned::exp(-s.dt / s.materials.skin.release_tau);
  s.state.release_D = pack(Vec3(keep * unpack(s.state.release_D)));
  s.push(unpack(s.state.release_D), s.pose.p_DT);
}

void puncture(NeedleTick& s, const Vec3& n, double x) {
  const double inserted = x / std::max(-s.pose.a_D.dot(n), kSteepest);
  s.state.phase = NeedlePhase::inserted;
  s.state.entry_D = pack(Vec3(s.pose.p_DT - inserted * s.pose.a_D));
  s.state.friction_anchor = inserted;
  s.state.release_D = pack(s.out.f_D);
  s.state.walls_front = s.state.walls_back = 0;
  if (s.state.skin_punctures < 255) ++s.state.skin_punctures;
  s.out.events |= kSkinPunctured;
}

void beforePuncture(NeedleTick& s) {
  const PatchContact skin = nearestOn(s.geometry.skin, s.pose.p_DT);
  const Vec3 n = skin.normal;
  const double x = -skin.distance;
  s.state.was_outside |= x <= 0;
  if (!s.state.was_outside || x <= 0) {
    s.out.depth = std::max(x, 0.0);
    s.state.phase = NeedlePhase::outside;
    s.state.skin_anchor_D = pack(s.pose.p_DT);
    s.state.relaxation = RelaxationState{};
    return;
  }
  s.state.phase = NeedlePhase::indenting;
  s.out.indentation = indentationInSeries(s.materials.skin, s.coupling.stiffness, x);
  s.out.skin_force = relaxed(s.materials.skin.relaxation, s.state.relaxation,
                             s.materials.skin.force(s.out.indentation), s.dt);
  const bool gives = s.out.skin_force >= s.commands.puncture_force_N;
  if (gives) s.out.skin_force = std::max(s.commands.puncture_force_N, 0.0);
  const SkinLaw& law = s.materials.skin;
  s.push(s.out.skin_force * n + dragAcross(s.state.skin_anchor_D, s.pose.p_DT, n, law.shear,
                                           law.friction * s.out.skin_force),
         s.pose.p_DT);
  if (gives) puncture(s, n, x);
}

/// Stick–slip of cutting and shaft friction: an anchor that yields at the limit of either
/// direction.
double axialFriction(NeedleTick& s, double insertion, double advancing, double retracting) {
  const double k = kStickShare * s.coupling.stiffness;
  const double stretch =
      std::clamp(insertion - s.state.friction_anchor, -retracting / k, advancing / k);
  s.state.friction_anchor = insertion - stretch;
  return -k * stretch;
}

void holdLaterally(NeedleTick& s, double insertion) {
  const Vec3 axis_point = s.pose.p_DT - insertion * s.pose.a_D;
  const double ramp = std::clamp(insertion / kLateralRamp, 0.0, 1.0);
  const double k = ramp * (s.materials.lateral_stiffness +
                           s.materials.lateral_per_depth * std::max(insertion, 0.0));
  s.push(-std::min(k, s.coupling.stiffness) * (axis_point - unpack(s.state.entry_D)), axis_point);
}

/// What a wall had stored and now lets go; never more than was felt before it gave way.
void letGo(NeedleTick& s, const Vec3& f) {
  const Vec3 released = unpack(s.state.release_D) + f;
  const double size = released.norm(), felt = s.out.f_D.norm();
  s.state.release_D = pack(size > felt ? Vec3(released * (felt / size)) : released);
}

void pushWall(NeedleTick& s, const TissueWalk& walk) {
  if (walk.wall != s.state.pushed || walk.wall_leaving != bool(s.state.pushed_leaving)) {
    s.state.wall_relaxation = RelaxationState{};
    s.state.pushed = walk.wall;
    s.state.pushed_leaving = walk.wall_leaving;
  }
  if (walk.wall == Organ::none) return;
  const auto index = static_cast<std::size_t>(walk.wall);
  const WallLaw& law = s.materials.walls[index];
  s.out.wall = walk.wall;
  s.out.wall_leaving = walk.wall_leaving;
  s.out.wall_force = relaxed(law.relaxation, s.state.wall_relaxation,
                             std::min(law.stiffness, s.coupling.stiffness) * walk.wall_depth, s.dt);
  const double peak = law.peak * static_cast<double>(s.commands.wall_scale[index]);
  const bool gives = s.out.wall_force >= peak;
  if (gives) s.out.wall_force = std::max(peak, 0.0);
  const Vec3 f = -s.out.wall_force * s.pose.a_D;
  s.push(f, s.pose.p_DT);
  if (!gives) return;
  (walk.wall_leaving ? s.state.walls_back : s.state.walls_front) |= 1u << index;
  letGo(s, f);
  s.out.events |= kWallPunctured;
}

void withdraw(NeedleTick& s) {
  s.state.phase = NeedlePhase::outside;
  s.state.was_outside =
      0;  // behind a flat needle the skin may bulge: it is felt again once the point is clear of it
  s.state.walls_front = s.state.walls_back = 0;
  s.state.release_D = {0, 0, 0};
  s.state.skin_anchor_D = pack(s.pose.p_DT);
  s.out.events |= kWithdrawn;
}

void afterPuncture(NeedleTick& s) {
  const double insertion = (s.pose.p_DT - unpack(s.state.entry_D)).dot(s.pose.a_D);
  if (insertion < -kLeftSkin || nearestOn(s.geometry.skin, s.pose.p_DT).distance > kTornOut)
    return withdraw(s);
  const TissueWalk walk =
      walkTissues(s.materials, s.geometry, s.pose.p_DT, s.pose.a_D, std::max(insertion, 0.0),
                  {s.state.walls_front, s.state.walls_back});
  s.state.walls_front = walk.passed.front;
  s.state.walls_back = walk.passed.back;
  s.out.tissue = walk.tissue;
  s.out.depth = std::max(insertion, 0.0);
  const LayerLaw& layer = s.materials.layers[static_cast<int>(walk.tissue)];
  const double friction =
      axialFriction(s, insertion, layer.cutting + walk.shaft_friction, walk.shaft_friction);
  s.push((friction - layer.viscosity * s.out.v_axial) * s.pose.a_D, s.pose.p_DT);
  holdLaterally(s, insertion);
  pushWall(s, walk);
}

void pushBones(NeedleTick& s) {
  const Vec3 hub = s.pose.p_DT - s.materials.needle_length * s.pose.a_D;
  const BoneTouch touch = touchBones(s.geometry, hub, s.pose.p_DT, s.materials.needle_radius,
                                     s.coupling.stiffness, s.state.bone);
  for (int i = 0; i < touch.count; ++i) s.push(touch.each[i].f_D, touch.each[i].p_D);
  s.out.bone_force = touch.largest;
  s.out.events |= touch.events;
  s.state.bone = touch.organ;
}

}  // namespace

NeedleContact needleContact(const NeedleMaterials& materials, const CouplingLimits& coupling,
                            const LocalGeometry& geometry, const NeedlePose& pose,
                            const TickCommands& commands, double dt, NeedleState& state) noexcept {
  NeedleTick step{materials, coupling, geometry, pose, commands, dt, state, {}};
  follow(state.motion, pose.p_DT, coupling.velocity_tau, dt);
  step.out.v_axial = unpack(state.motion.v_D).dot(pose.a_D);
  if (geometry.number == 0) return step.out;
  if (state.phase == NeedlePhase::inserted) {
    decayRelease(step);
    afterPuncture(step);
  } else {
    beforePuncture(step);
  }
  if (state.phase == NeedlePhase::inserted)
    pushBones(step);
  else
    state.bone = Organ::none;
  return step.out;
}

}  // namespace palpa::haptics
