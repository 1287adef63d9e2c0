#include "anatomy/base/pinned_math.h"
#include "haptics/loop/tick_frame.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

constexpr double kFarAway = 1;  // m: there is no lump
// px/s: 2 px in a millisecond, half the finest wavelength. 468.75 U/s where 1024 px are 240 U
constexpr double kFirstScale = 2000;

struct FloorFrame {
  Pose X_DF;
  explicit FloorFrame(const TickConfig& config) : X_DF(unpack(config.X_DF)) {}
  Vec3 toF(const Vec3& v_D) const { return X_DF.linear().transpose() * v_D; }
  Vec3 toD(const Vec3& v_F) const { return X_DF.linear() * v_F; }
};

/// The handle before an episode: a weak spring to its start, so that the hand follows it.
Vec3 holdForce(const FloorRendering& law, const Vec3& p_F, const Vec3& v_F) noexcept {
  constexpr double kDamping = 5;  // N s/m
  const Vec3 f =
      law.hold_stiffness * (Vec3(0, 0, law.start_height * law.unit) - p_F) - kDamping * v_F;
  const double size = f.norm();
  return size > law.hold_force_N ? Vec3(f * (law.hold_force_N / size)) : f;
}

/// From the nearest lump's edge, along the surface over it; below 0: over the lump.
double lumpEdge(const TickConfig& config, const TickFrame& frame) noexcept {
  double nearest = kFarAway;
  const Vec3 p_P = touchIn(config, frame.record.sensed).p_M;
  for (const PlacedLump& lump : frame.record.commands.lumps) {
    if (lump.kind < 1 || lump.kind > kMostLumpKinds || lump.taken > 0) continue;
    const Vec3 n = outwardOver(lump), from = p_P - unpack(lump.p_T0);
    const double across = n == Vec3::UnitZ() ? pinned::hypot(from.x(), from.y())
                                             : Vec3(from - from.dot(n) * n).norm();
    nearest = std::min(nearest, across - config.lump_radius[lump.kind - 1]);
  }
  return nearest;
}

/// Computed, or sensed of a real thing.
Vec3 feltForce(const TickConfig& config, const NeedleContact& contact,
               const SensedForce& sensed) noexcept {
  return config.contact_mode == ContactMode::sensed_object && sensed.state == SensorState::valid
             ? unpack(sensed.f_D)
             : contact.f_D;
}

/// The belief of a learned model goes on; while the handle is held, nothing is done that it knows.
void believeLearned(const TickConfig& config, TickState& state, const Vec3& f,
                    const TickFrame& frame) noexcept {
  LearnedState& learned = state.augmentation.learned;
  if (frame.record.commands.held)
    learned = {};
  else
    learnedState(config.augmentations.learned, unpack(state.tip.v_D).norm(), f,
                 static_cast<std::int64_t>(1e9 * frame.input.dt + 0.5), &learned);
}

SignalValues signalsOf(const TickConfig& config, const TickState& state,
                       const NeedleContact& contact, const FloorTouch* touch,
                       const TickFrame& frame) noexcept {
  SignalValues signals;
  const FlightRecord& record = frame.record;
  signals[Signal::speed] = unpack(state.tip.v_D).norm();
  signals[Signal::advance] = contact.v_axial;
  const bool sensed = config.contact_mode == ContactMode::sensed_object &&
                      record.sensed.state == SensorState::valid;
  signals[Signal::contact_force] = feltForce(config, contact, record.sensed).norm();
  signals[Signal::skin_force] = contact.skin_force;
  signals[Signal::wall_force] = contact.wall_force;
  signals[Signal::bone_force] = contact.bone_force;
  signals[Signal::indentation] = contact.indentation;
  signals[Signal::depth] = contact.depth;
  signals[Signal::phase] = static_cast<double>(state.contact.phase);
  signals[Signal::tissue] = static_cast<double>(contact.tissue);
  signals[Signal::part] = record.commands.subtask;
  signals[Signal::learned] = 1 + state.augmentation.learned.state;
  signals[Signal::lump_edge] = sensed ? lumpEdge(config, frame) : kFarAway;
  if (!touch) return signals;
  signals[Signal::floor_contact] = touch->touching;
  signals[Signal::floor_texture] = touch->place.texture;
  const Vec3 v_F = FloorFrame(config).toF(unpack(state.tip.v_D));
  signals[Signal::floor_speed] = pinned::hypot(v_F.x(), v_F.y()) / config.floor.unit;
  return signals;
}

/// What the floor itself tells: rises and bumps under the probe's way, the valley nearby.
void lookAtFloor(const TickConfig& config, const Floor& floor, const FloorTouch& touch,
                 const Vec3& dp_F, AugmentationInput* in) noexcept {
  const Vec3 p = touch.p_U, before = p - dp_F / config.floor.unit,
             v_F = FloorFrame(config).toF(in->v);
  const double speed = in->signals[Signal::floor_speed];
  if (floor.rises && touch.touching && speed > 0)
    in->rise = floor.rises->rises(
        p.x(), p.y(), GaborTable::directionOf(v_F.x(), v_F.y()),
        GaborTable::scaleOf(speed, kFirstScale * floor.rises->side() / floor.rises->size()));
  in->bump = touch.touching && floor.surface->crossesBump(before.x(), before.y(), p.x(), p.y());
  if (touch.touching)
    in->footprint =
        floor.surface->bumpOnWay(before.x(), before.y(), p.x(), p.y()) /
        std::max(floor.surface->spec().target.radius, floor.surface->spec().distractor.radius);
  if (!floor.valleys || !touch.touching) return;
  const NearestValley valley = floor.valleys->nearest(p.x(), p.y());
  if (!valley.found) return;
  in->to_valley = FloorFrame(config).toD(config.floor.unit * Vec3(valley.dx, valley.dy, 0));
  in->valley_radius = valley.radius;
}

/// Out of what is touched: where that is real, by its shape under the tool, which no friction
/// bends.
Vec3 upOf(const TickConfig& config, const TickState& state, const SensedForce& sensed) noexcept {
  switch (config.contact_mode) {
    case ContactMode::floor:
      return FloorFrame(config).toD(Vec3::UnitZ());
    case ContactMode::sensed_object:
      return unpack(config.X_DP.q).normalized() *
             (config.top.flat() ? Vec3(Vec3::UnitZ())
                                : nearestOn(config.top, touchIn(config, sensed).p_M).n);
    case ContactMode::needle:
    case ContactMode::probe:
      return state.now.number ? unpack(state.now.skin.n) : Vec3(Vec3::Zero());
  }
  return Vec3::Zero();
}

Vec3 toLine(const TickCommands& commands, const Vec3& p_D) noexcept {
  const Vec3 a = unpack(commands.line_a_D);
  if (!(std::abs(a.norm() - 1) < 1e-6)) return Vec3::Zero();
  const Vec3 d = unpack(commands.line_p_D) - p_D;
  return d - d.dot(a) * a;
}

/// The way out of every region that the tip is in, all together.
Vec3 outOf(const TickCommands& commands, const Vec3& p_D) noexcept {
  constexpr double kMiddle = 1e-6;  // m: there no way is the shortest
  constexpr double kLargest = 1;    // m: larger than any device's workspace
  Vec3 out = Vec3::Zero();
  for (const KeptOut& region : commands.kept_out) {
    const Vec3 from = p_D - unpack(region.p_D);
    const double far = from.norm(), deep = region.radius - far;
    if (deep > 0 && far > kMiddle && region.radius <= kLargest) out += deep / far * from;
  }
  return out;
}

/// What the cues were computed from, and what they gave.
void describeCues(const AugmentationInput& in, const Augmented& added,
                  TickForces* forces) noexcept {
  forces->cues = added.each;
  forces->up = in.up;
  forces->footprint = in.footprint;
  forces->to_valley = in.to_valley;
  forces->valley_radius_U = in.valley_radius;
  forces->to_line = in.to_line;
  forces->out_of = in.out_of;
}

}  // namespace

NeedleContact floorContact(const TickConfig& config, TickState& state, const Floor* floor,
                           TickFrame* frame, FloorTouch* touch) noexcept {
  const FloorFrame f(config);
  const Vec3 p_D = frame->pose.p_DT, p_F = f.toF(p_D - f.X_DF.translation());
  follow(state.floor.motion, p_D, config.coupling.velocity_tau, frame->input.dt);
  const Vec3 v_F = f.toF(unpack(state.floor.motion.v_D));
  const TickCommands& commands = frame->record.commands;
  Vec3 hold_F(0, 0, config.floor.weight_N);
  NeedleContact contact;
  if (commands.held) {
    hold_F += holdForce(config.floor, p_F, v_F);
  } else if (floor && floor->surface) {
    *touch =
        touchFloor(*floor->surface, commands.degraded ? config.floor.degraded : config.floor.real,
                   config.coupling.stiffness, config.floor.unit, p_F, v_F);
    contact.f_D = f.toD(touch->f_F);
    contact.indentation = touch->penetration;
  }
  if (commands.force_feedback) frame->f_hold_D = f.toD(hold_F);
  state.floor.touching = touch->touching;
  frame->forces.on_floor_U = p_F / config.floor.unit;
  frame->forces.held = frame->f_hold_D;
  frame->record.place = placeBits(*touch);
  return contact;
}

void addAugmentations(const TickConfig& config, TickState& state, const NeedleContact& contact,
                      const Floor* floor, const FloorTouch* touch, TickFrame* frame) noexcept {
  const AugmentationPlan& plan = config.augmentations;
  frame->f_source_D += frame->f_pulse_D;
  frame->forces.pulse = frame->f_pulse_D;
  frame->record.f_augmentation_D = pack(frame->f_pulse_D);
  if (plan.subtasks.count == 0 && plan.count == 0) return;
  const Vec3 p_D = frame->pose.p_DT;
  AugmentationInput in;
  if (state.tip.started) in.dp = p_D - unpack(state.tip.p_D);
  follow(state.tip, p_D, plan.speed_tau, frame->input.dt);
  believeLearned(config, state, feltForce(config, contact, frame->record.sensed), *frame);
  in.signals = signalsOf(config, state, contact, touch, *frame);
  in.events = contact.events;
  in.allowed = frame->record.commands.augmented;
  in.f_contact = contact.f_D;
  in.v = unpack(state.tip.v_D);
  in.up = upOf(config, state, frame->record.sensed);
  in.tool = frame->pose.a_D;
  in.to_line = toLine(frame->record.commands, p_D);
  in.out_of = outOf(frame->record.commands, p_D);
  in.support = frame->record.commands.support;
  in.dt = frame->input.dt;
  in.now_ns = frame->input.now_ns;
  if (in.allowed && touch && floor && floor->surface)
    lookAtFloor(config, *floor, *touch, FloorFrame(config).toF(in.dp), &in);
  const Augmented added = augment(plan, in, &state.augmentation);
  FlightRecord& record = frame->record;
  record.f_augmentation_D = pack(Vec3(added.f + frame->f_pulse_D));
  record.subtasks = static_cast<std::uint8_t>(added.subtasks);
  record.augmenting = static_cast<std::uint8_t>(added.active);
  record.began = static_cast<std::uint8_t>(added.began);
  frame->f_source_D += added.f_source;
  describeCues(in, added, &frame->forces);
}

}  // namespace palpa::haptics
