#include "haptics/augmentation/augmentation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr std::uint32_t kElapsedStarted = 1u << 31;
constexpr double kStill = 1e-4;  // m/s: below, motion has no direction
constexpr double kDecayed = 5;   // time constants after which a vibration is over

/// One of them, in this tick.
struct ActiveAugmentation {
  const Augmentation& a;
  const AugmentationInput& in;
  AugmentationState& state;
  std::size_t i;
  double weight() const { return state.weight[i] * (a.fades ? share() : 1); }
  double share() const { return in.support > 0 ? std::min(in.support, 1.0) : 0; }
};

Vec3 wayOf(const ActiveAugmentation& p) noexcept {
  switch (p.a.way) {
    case Augmentation::Way::up:
      return p.in.up;
    case Augmentation::Way::along_tool:
      return p.in.tool;
    case Augmentation::Way::against_tool:
      return -p.in.tool;
    case Augmentation::Way::against_motion: {
      const double speed = p.in.v.norm();
      return speed > kStill ? Vec3(-p.in.v / speed) : Vec3(Vec3::Zero());
    }
  }
  return Vec3::Zero();
}

/// What would trigger it is there now; whether that is new says `fires`.
bool triggerPresent(const ActiveAugmentation& p, std::uint32_t parts_begun) noexcept {
  switch (p.a.trigger) {
    case Augmentation::Trigger::none:
      return false;
    case Augmentation::Trigger::begin:
      return p.a.subtask != kAnySubtask && (parts_begun >> p.a.subtask & 1u);
    case Augmentation::Trigger::event:
      return p.in.events & p.a.events;
    case Augmentation::Trigger::rise:
      return p.in.rise;
    case Augmentation::Trigger::bump:
      return p.in.bump;
  }
  return false;
}

/// A rise lasts for many ticks and counts once; bumps are told once each by themselves.
bool fires(const ActiveAugmentation& p, std::uint32_t parts_begun, bool on) noexcept {
  const bool now = triggerPresent(p, parts_begun);
  const std::uint32_t bit = 1u << p.i;
  const bool before = p.state.was & bit;
  p.state.was = now ? p.state.was | bit : p.state.was & ~bit;
  const bool is_new = p.a.trigger == Augmentation::Trigger::rise ? now && !before : now;
  return is_new && on;
}

Vec3 pulse(const ActiveAugmentation& p) noexcept {
  const double t = p.state.elapsed[p.i];
  return t >= 0 && t < p.a.width_s ? Vec3(p.a.amplitude * wayOf(p)) : Vec3(Vec3::Zero());
}

Vec3 vibration(const ActiveAugmentation& p) noexcept {
  double size = p.a.amplitude;
  if (p.a.trigger != Augmentation::Trigger::none) {
    const double t = p.state.elapsed[p.i];
    if (t < 0 || p.a.tau_s <= 0 || t > kDecayed * p.a.tau_s) return Vec3::Zero();
    size *= pinned::exp(-t / p.a.tau_s);
  }
  double& way = p.state.way[p.i];
  const bool by_place = p.a.wavelength > 0;
  const Vec3 along = p.in.dp - p.in.dp.dot(p.in.up) * p.in.up;
  way += by_place ? along.norm() / p.a.wavelength : p.a.frequency_Hz * p.in.dt;
  way -= std::floor(way);
  return p.weight() * size * pinned::sin(kTwoPi * way) * wayOf(p);
}

Vec3 attraction(const ActiveAugmentation& p, double steepest) noexcept {
  const double d = p.in.to_valley.norm();
  if (p.in.valley_radius <= 0 || d <= 0 || p.a.reach <= 0) return Vec3::Zero();
  const double held = attractionHeld(p.a.amplitude, p.a.reach, p.in.valley_radius, steepest);
  return p.weight() * attractionForce(held, d, p.a.reach, p.in.valley_radius) * p.in.to_valley / d;
}

Vec3 exaggeration(const ActiveAugmentation& p) noexcept {
  const std::uint32_t bit = 1u << p.i;
  const Vec3 before = p.state.started & bit ? unpack(p.state.slow[p.i]) : p.in.f_contact;
  const Vec3 slow = before + (p.in.f_contact - before) * (p.in.dt / (p.a.tau_s + p.in.dt));
  p.state.slow[p.i] = pack(slow);
  p.state.started |= bit;
  return p.weight() * p.a.amplitude * (p.in.f_contact - slow);
}

Vec3 fixture(const ActiveAugmentation& p, double steepest) noexcept {
  const double held = std::min(p.a.amplitude, steepest), reach2 = p.a.reach * p.a.reach;
  double share = 1;
  if (p.a.reach > 0) share = std::max(0.0, 1 - p.in.to_line.squaredNorm() / reach2);
  return p.weight() * held * share * share * p.in.to_line;
}

/// C(s) of safety/passive_law.h by the trapezoidal rule, which keeps it positive real, as a
/// state-variable filter (two integrators and their sum): y = 2 z through.
Vec3 steadying(const ActiveAugmentation& p) noexcept {
  if (!(p.a.from_Hz > 0) || !(p.a.to_Hz > p.a.from_Hz) || !(p.in.dt > 0)) return Vec3::Zero();
  const double middle = std::sqrt(p.a.from_Hz * p.a.to_Hz), g = 0.5 * kTwoPi * middle * p.in.dt,
               r = (p.a.to_Hz - p.a.from_Hz) / middle;
  const Vec3 first = unpack(p.state.slow[p.i]), second = unpack(p.state.band[p.i]);
  const Vec3 v = p.in.dp / p.in.dt, through = (first + g * (v - second)) / (1 + g * (g + r)),
             held = second + g * through;
  p.state.slow[p.i] = pack(Vec3(2 * through - first));
  p.state.band[p.i] = pack(Vec3(2 * held - second));
  return -p.weight() * p.a.amplitude * r * through;
}

Vec3 forceOf(const ActiveAugmentation& p, double steepest) noexcept {
  switch (p.a.kind) {
    case AugmentationKind::none:
      return Vec3::Zero();
    case AugmentationKind::pulse:
      return pulse(p);
    case AugmentationKind::vibration:
      return vibration(p);
    case AugmentationKind::attraction:
      return attraction(p, steepest);
    case AugmentationKind::exaggeration:
      return exaggeration(p);
    case AugmentationKind::relief:
      return p.weight() * p.a.amplitude * p.in.footprint * wayOf(p);
    case AugmentationKind::fixture:
      return fixture(p, steepest);
    case AugmentationKind::keep_out:
      return p.weight() * std::min(p.a.amplitude, steepest) * p.in.out_of;
    case AugmentationKind::steadying:
      return steadying(p);
  }
  return Vec3::Zero();
}

bool heedsMotion(AugmentationKind kind) noexcept {
  return kind != AugmentationKind::pulse && kind != AugmentationKind::vibration &&
         kind != AugmentationKind::relief;
}

void advance(const ActiveAugmentation& p, bool on) noexcept {
  const double step = p.a.blend_s > 0 ? p.in.dt / p.a.blend_s : 1;
  p.state.weight[p.i] = std::clamp(p.state.weight[p.i] + (on ? step : -step), 0.0, 1.0);
  if (p.state.elapsed[p.i] >= 0) p.state.elapsed[p.i] += p.in.dt;
}

/// A pulse that is on is not begun anew: its width is what is felt.
bool running(const ActiveAugmentation& p) noexcept {
  return p.a.kind == AugmentationKind::pulse && p.state.elapsed[p.i] >= 0 &&
         p.state.elapsed[p.i] < p.a.width_s;
}

}  // namespace

double attractionForce(double amplitude, double d, double d_max, double radius) noexcept {
  return d < 0 || d > d_max ? 0 : amplitude * (1 - pinned::cos(kTwoPi * d / d_max)) / radius;
}

double attractionHeld(double amplitude, double d_max, double radius, double steepest) noexcept {
  return std::min(amplitude, steepest * d_max * radius / kTwoPi);
}

Augmented augment(const AugmentationPlan& plan, const AugmentationInput& in,
                  AugmentationState* state) noexcept {
  Augmented out;
  const std::uint32_t begun = detect(plan.subtasks, in.signals, in.now_ns, &state->subtasks);
  out.subtasks = state->subtasks.on;
  if (!(state->started & kElapsedStarted)) state->elapsed.fill(-1);
  state->started |= kElapsedStarted;
  if (!in.allowed) {
    AugmentationState told;  // parts are told all the same
    told.subtasks = state->subtasks;
    told.learned = state->learned;
    *state = told;
    return out;
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(plan.count, kMostAugmentations); ++i) {
    const ActiveAugmentation part{plan.each[i], in, *state, i};
    const bool on = part.a.subtask == kAnySubtask || (out.subtasks >> part.a.subtask & 1u);
    advance(part, on);
    if (fires(part, begun, on) && !running(part)) {
      state->elapsed[i] = 0;
      out.began |= 1u << i;
    }
    const Vec3 f = forceOf(part, plan.steepest);
    if (f.squaredNorm() > 0) out.active |= 1u << i;
    out.f += f;
    out.each[i] = f;
    if (!heedsMotion(part.a.kind)) out.f_source += f;
  }
  const double size = out.f.norm(), share = size > plan.largest ? plan.largest / size : 1;
  out.f *= share;
  out.f_source *= share;
  for (Vec3& f : out.each) f *= share;
  return out;
}

}  // namespace palpa::haptics
