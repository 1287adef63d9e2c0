#pragma once

#include <cstring>
#include <limits>
#include <random>

#include "haptics/loop/tick_config.h"
#include "needle_bench.h"
#include "tests/surface/surface_bench.h"

namespace palpa::haptics {

/// Seeded, the same on every machine: the distributions of the standard library are not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}
  double uniform(double a, double b) {
    return a + (b - a) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(bits_() % static_cast<std::uint64_t>(n)); }
  std::uint64_t bits() { return bits_(); }
  bool chance(double p) { return uniform(0, 1) < p; }
  /// A number that no sound sender sends.
  double absurd() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const double all[] = {
        std::numeric_limits<double>::quiet_NaN(), kInf, -kInf, 1e300, -1e300, 1e154, -50};
    return all[below(7)];
  }

 private:
  std::mt19937_64 bits_;
};

enum class Fault {
  none,
  position_absurd,
  orientation_absurd,
  position_jump,
  orientation_jump,
  clock_still,
  clock_back,
  clock_leap,
  packets_dropped,
  no_snapshots,
  snapshot_damaged,
  snapshot_random_bytes,
  emergency_stop,
  not_homed,
  disarmed,
  button_released,
  commands_absurd,
  sensor_absurd,
  trial_changes,
  sensor_silent
};
inline constexpr int kFaultCount = 20;

inline constexpr HuntCrossley kSoftThing{900, 300, 1.4};

/// A hand that pushes a tool in and out of tissue with a bone, and a world that can be told to
/// fail. Knows nothing of the tick: it only makes its inputs.
struct FaultyWorld {
  Dice& dice;
  bool cues = false;          ///< a task's cues of every kind add force
  bool lump_is_real = false;  ///< the second lump, which is taken off
  TickConfig config;
  TickCommands commands;
  DeviceReading reading;
  SensedForce sensed;
  LocalGeometry sound = NeedleBench{}.geometry, offered;
  bool offers = false;
  bool damaged = false;         ///< `offered` must not be adopted
  bool reading_absurd = false;  ///< must not be believed
  bool sensor_absurd = false;   ///< nor must that
  std::int64_t now = 0;
  std::uint64_t numbers = 0;
  int ticks = 0;
  double depth = -0.001, target = 0.002;
  Vec3 shift = Vec3::Zero();  ///< where a jump put the device
  Quat turn = Quat::Identity();

  FaultyWorld(Dice& dice_in, ContactMode contact_mode, bool with_cues)
      : dice(dice_in), cues(with_cues) {
    config.materials = NeedleBench{}.materials;
    config.contact_mode = contact_mode;
    config.X_ET.p = {0, 0, 0.11};
    config.period_ns = dice.chance(0.5) ? 1'000'000 : 250'000;
    config.blend_ns = 1'000'000 * (1 + dice.below(20));
    config.safety.max_force_N = dice.uniform(0.1, 10);
    config.safety.max_slew_N_per_s = dice.chance(0.5) ? 2000 : dice.uniform(10, 1e5);
    config.safety.max_energy_J = dice.uniform(1e-3, dice.chance(0.5) ? 5 : 3e-3);
    config.safety.continuous_force_N = dice.chance(0.5) ? 0 : dice.uniform(0.05, 1);
    config.safety.thermal_tau = dice.uniform(0.05, 1);
    config.object_at_port = dice.chance(0.5);
    config.safety.deadman_button = dice.chance(0.3) ? 4 : 0;
    config.coupling.stiffness = dice.uniform(200, 3000);
    config.passivity.max_damping = dice.chance(0.5) ? 0 : dice.uniform(1, 10);
    sound.bone_count = 1;
    sound.bones[0] = {{-0.02, 0, -0.012}, {0.02, 0, -0.012}, 0.004, Organ::rib};
    commands.armed = 1;
    commands.trial = 1;
    reading.homed = 1;
    config.touch.surface.contact = {kSoftThing, 0, {0.3, 1000, 0.5}, {0, 2}, 0.1};
    config.touch.surface.wanted = {0.5, 1000, 0.5};
    config.touch.other_friction = dice.chance(0.5);
    config.touch.kinds[0] = {
        0.014,
        {8000, 0, 1.9},
        {HuntCrossley{600, 0, 1}, HuntCrossley{600, 0, 1}, HuntCrossley{300, 0, 1.1}}};
    config.touch.tip_radius = 0.008;
    config.floor.weight_N = dice.uniform(0, 0.5);
    if (with_cues) nameCues();
    lump_is_real = dice.chance(0.5);
  }

  /// What is under a probe in the tick: a floor, where there is one.
  const Floor* floor() const {
    static const SearchSurface surface = searchFloor(5);
    static const Floor there{&surface, nullptr, nullptr};
    return config.contact_mode == ContactMode::floor ? &there : nullptr;
  }

  /// The inputs of the next tick, with this fault.
  void advance(Fault fault) {
    moveHand();
    ++ticks;
    const std::uint32_t trial = commands.trial;
    commands = TickCommands{};
    commands.trial = trial;
    commands.armed = 1;
    commands.augmented = cues;
    commands.line_a_D = {1, 0, 0};
    commands.lumps[0] = {{0.002, 0, -0.014}, 1};
    commands.lumps[3] = {{-0.01, 0.004, -0.014}, 1};
    if (lump_is_real) commands.lumps[3].taken = 1;
    commands.kept_out[0] = {pack(Vec3(0, 0, -0.01)), 0.012};
    commands.support = 0.7;
    sense();
    reading.homed = 1;
    reading.buttons = 7;
    moveClock(fault);
    read(fault);
    offer(fault);
    command(fault);
  }

  /// Begins a fault that has a place of its own.
  void begin(Fault fault) {
    if (fault == Fault::position_jump)
      shift = Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)).normalized() *
              dice.uniform(0.1, 3);
    if (fault == Fault::orientation_jump)
      turn = Quat(
          Eigen::AngleAxisd(dice.uniform(1.2, 3), Vec3(dice.uniform(-1, 1), 1, 0).normalized()));
  }
  void end() {
    shift = Vec3::Zero();
    turn = Quat::Identity();
  }

 private:
  /// One of every kind, stronger than any device; parts that come and go with the contact.
  void nameCues() {
    AugmentationPlan& plan = config.augmentations;
    plan.subtasks.count = 1;
    plan.subtasks.each[0].count = 1;
    plan.subtasks.each[0].conditions[0] = {
        Signal::contact_force, Condition::Compare::at_least, 0, {}, dice.uniform(0.01, 0.5), 0.05};
    for (const AugmentationKind kind :
         {AugmentationKind::pulse, AugmentationKind::vibration, AugmentationKind::attraction,
          AugmentationKind::exaggeration, AugmentationKind::fixture, AugmentationKind::relief,
          AugmentationKind::keep_out, AugmentationKind::steadying}) {
      Augmentation& a = plan.each[plan.count++];
      a.kind = kind;
      a.subtask = dice.chance(0.5) ? kAnySubtask : 0;
      a.amplitude = kind == AugmentationKind::fixture || kind == AugmentationKind::keep_out
                        ? dice.uniform(10, 1e5)
                        : dice.uniform(0.1, 50);
      a.trigger = kind == AugmentationKind::pulse    ? Augmentation::Trigger::begin
                  : kind == AugmentationKind::relief ? Augmentation::Trigger::bump
                                                     : Augmentation::Trigger::none;
      a.frequency_Hz = dice.uniform(20, 300);
      a.reach = 0.001;
      a.tau_s = dice.uniform(0.005, 0.1);
      a.from_Hz = dice.uniform(5, 10);
      a.to_Hz = dice.uniform(8, 40);
      a.fades = dice.chance(0.5);
    }
    plan.largest = dice.uniform(0, 20);
    plan.steepest = config.coupling.stiffness;
  }

  void moveHand() {
    const double step = 0.05 * 1e-9 * static_cast<double>(config.period_ns);  // 5 cm/s
    depth += std::clamp(target - depth, -step, step);
  }

  /// A soft thing at z < 0, wherever a jump says that the device is.
  void sense() {
    const Vec3 f(0, 0,
                 config.contact_mode == ContactMode::sensed_object
                     ? forceOf(kSoftThing, std::max(depth, 0.0), 0)
                     : 0.1);
    sensed = {pack(f), pack(Vec3(Vec3(0, 0, -depth) + shift)), SensorState::valid, {}};
    sensor_absurd = false;
  }

  void moveClock(Fault fault) {
    if (fault == Fault::clock_still) return;
    if (fault == Fault::clock_back) {
      now -= static_cast<std::int64_t>(dice.uniform(1, dice.chance(0.5) ? 1e6 : 2e9));
    } else if (fault == Fault::clock_leap) {
      now = dice.chance(0.02)
                ? static_cast<std::int64_t>(dice.uniform(-1e15, 1e15))
                : now + static_cast<std::int64_t>(dice.uniform(1e6, dice.chance(0.5) ? 3e7 : 1e10));
    } else {
      now += config.period_ns;
    }
  }

  void read(Fault fault) {
    if (fault == Fault::packets_dropped) return;
    ++reading.sequence;
    reading.t_ns = now;
    const double across =
        config.contact_mode == ContactMode::floor
            ? 0.004 + 0.0015 * std::sin(6e-9 * static_cast<double>(ticks * config.period_ns))
            : 0;
    reading.p_DE = pack(Vec3(Vec3(across, 0, 0.11 - depth) + shift));
    reading.q_DE = pack(Quat(turn * Quat(0, 1, 0, 0)));  // tool down
    reading_absurd = fault == Fault::position_absurd || fault == Fault::orientation_absurd;
    if (fault == Fault::position_absurd)
      reading.p_DE[static_cast<std::size_t>(dice.below(3))] = dice.absurd();
    if (fault == Fault::orientation_absurd) {
      if (dice.chance(0.2))
        reading.q_DE = {0, 0, 0, 0};
      else
        reading.q_DE[static_cast<std::size_t>(dice.below(4))] = dice.absurd();
    }
  }

  void offer(Fault fault) {
    const bool harmed = fault == Fault::snapshot_damaged || fault == Fault::snapshot_random_bytes;
    if (fault == Fault::no_snapshots || (!harmed && offers && ticks % 8 != 0)) return;
    offered = sound;
    offered.number = ++numbers;
    offered.t_ns = now;
    offers = true;
    damaged = fault == Fault::snapshot_damaged;
    if (damaged) damage(offered);
    if (fault == Fault::snapshot_random_bytes) scribble(offered);
  }

  void damage(LocalGeometry& g) {
    const auto axis = static_cast<std::size_t>(dice.below(3));
    Boundary& boundary = g.boundaries[dice.below(g.boundary_count)];
    switch (dice.below(11)) {
      case 0:
        g.boundary_count = static_cast<std::int32_t>(17 + dice.below(1'000'000));
        break;
      case 1:
        g.boundary_count = -1 - dice.below(1'000'000);
        break;
      case 2:
        g.bone_count = dice.chance(0.5) ? LocalGeometry::kMaxBones + 1 + dice.below(100)
                                        : std::numeric_limits<std::int32_t>::min();
        break;
      case 3:
        g.skin.p[axis] = dice.absurd();
        break;
      case 4:
        g.skin.n[axis] = dice.absurd();
        break;
      case 5:
        g.skin.c[dice.below(SurfacePatch::kTerms)] = dice.chance(0.5) ? 1e12 : std::nan("");
        break;
      case 6:
        boundary.p[axis] = dice.absurd();
        break;
      case 7:
        boundary.n[axis] = dice.absurd();
        break;
      case 8:
        boundary.to = static_cast<Tissue>(kTissueCount + dice.below(200));
        break;
      case 9:
        g.bones[0].a[axis] = dice.absurd();
        break;
      default:
        g.bones[0].organ = static_cast<Organ>(kOrganCount + dice.below(200));
        break;
    }
  }

  void scribble(LocalGeometry& g) {
    unsigned char bytes[sizeof(LocalGeometry)];
    std::memcpy(bytes, &g, sizeof bytes);
    const int count = 1 + dice.below(dice.chance(0.5) ? 16 : static_cast<int>(sizeof bytes));
    for (int i = 0; i < count; ++i)
      bytes[dice.below(static_cast<int>(sizeof bytes))] = static_cast<unsigned char>(dice.bits());
    std::memcpy(static_cast<void*>(&g), bytes, sizeof bytes);
  }

  /// 50 N are absurd, yet a sensor may say so.
  void harmSensor() {
    const double value = dice.absurd();
    (dice.chance(0.5) ? sensed.f_D : sensed.p_DK)[static_cast<std::size_t>(dice.below(3))] = value;
    sensor_absurd = !std::isfinite(value) || unpack(sensed.f_D).norm() > 1000;
  }

  void command(Fault fault) {
    if (fault == Fault::emergency_stop)
      commands.emergency_stop = static_cast<std::uint8_t>(1 + dice.below(255));
    if (fault == Fault::not_homed) reading.homed = 0;
    if (fault == Fault::disarmed) commands.armed = 0;
    if (fault == Fault::button_released) reading.buttons = 3;
    if (fault == Fault::commands_absurd) {
      commands.puncture_force_N = dice.absurd();
      for (float& scale : commands.wall_scale) scale = static_cast<float>(dice.absurd());
      commands.lumps[0].p_T0[static_cast<std::size_t>(dice.below(3))] = dice.absurd();
      commands.line_p_D[0] = commands.line_a_D[1] = dice.absurd();
      commands.lumps[3].kind = static_cast<std::uint32_t>(dice.bits());
      commands.lumps[3].taken = static_cast<float>(dice.absurd());
      commands.kept_out[1] = {{dice.absurd(), 0, 0}, dice.absurd()};
      commands.support = dice.absurd();
    }
    if (fault == Fault::sensor_absurd) harmSensor();
    if (fault == Fault::sensor_silent)
      sensed.state = dice.chance(0.5) ? SensorState::unusable : SensorState::none;
    if (fault == Fault::trial_changes) ++commands.trial;
  }
};

}  // namespace palpa::haptics
