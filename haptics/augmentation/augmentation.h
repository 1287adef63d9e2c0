#pragma once

#include "anatomy/geometry/pose.h"
#include "haptics/augmentation/learned_part.h"
#include "haptics/augmentation/subtasks.h"

namespace palpa::haptics {

inline constexpr int kMostAugmentations = 8;
inline constexpr std::uint8_t kAnySubtask = 0xff;

/// What is added to the force; A: the amplitude.
enum class AugmentationKind : std::uint8_t {
  none,
  /// A along the way, for `width`, whatever the hand does meanwhile; one ends before the next
  /// begins
  pulse,
  vibration,  ///< A sin(2 pi f t), or A sin(2 pi s / wavelength) of the way s along the surface
  /// A (1 - cos(2 pi d / reach)) / r toward the nearest valley at the distance d <= reach, r its
  /// radius of curvature in U: smooth, 0 at both ends, 2 A / r at reach / 2
  attraction,
  /// A (f - low-pass f) of the contact force, time constant tau: what changes fast feels stronger
  exaggeration,
  /// a guide: spring of stiffness A toward a line, across it; with a reach, A d (1 - (d/reach)^2)^2
  /// at the distance d, and nothing beyond: who is far off is not drawn
  fixture,
  /// A h / h_max along the way while over a bump of height h, however deep the probe is: a
  /// texture that the device is too soft for
  relief,
  keep_out,  ///< a wall: spring of stiffness A out of a region that is entered
  /// -A v_b against what trembles: the part v_b of the tip's velocity that a band passes (see
  /// safety/passive_law.h for its law, its limit and its delay)
  steadying
};

/// What is added to the force while a part of the task is on, so that the cue that matters for it
/// is felt. Source of the method: Edmunds and Pai, Perceptually augmented simulator design (2012).
struct Augmentation {
  /// When a pulse or a decaying vibration begins; `none`: a vibration goes on as long as its part.
  enum class Trigger : std::uint8_t { none, begin, event, rise, bump };
  enum class Way : std::uint8_t {
    up,
    against_motion,
    along_tool,
    against_tool
  };  ///< up: outward from the surface
  AugmentationKind kind = AugmentationKind::none;
  Trigger trigger = Trigger::none;
  Way way = Way::up;
  std::uint8_t subtask = kAnySubtask;
  std::uint32_t events = 0;  ///< TickEvent bits that trigger it
  /// A: N; of an exaggeration times; of a fixture and a keep-out N/m; of a steadying N s/m
  double amplitude = 0;
  double width_s = 0.010;   ///< of a pulse
  double frequency_Hz = 0;  ///< f of a vibration
  double wavelength = 0;    ///< m; where given, in place of f
  double reach = 0;         ///< m, of an attraction, a fixture (0: any)
  double tau_s = 0;         ///< a vibration's decay after its trigger, an exaggeration's low-pass
  double blend_s = 0.02;    ///< in and out with its part, evenly
  double from_Hz = 0, to_Hz = 0;  ///< of a steadying: the band's ends
  std::uint8_t fades = 0;         ///< 1: times `support`, which falls as the trainee becomes better
  std::uint8_t reserved[7]{};
};
static_assert(std::is_trivially_copyable_v<Augmentation>);

/// Of a session; trivially copyable, so that its record has it whole.
struct AugmentationPlan {
  Subtasks subtasks;
  std::array<Augmentation, kMostAugmentations> each{};
  std::uint32_t count = 0;
  std::uint32_t reserved = 0;
  double largest = 0;  ///< N, of all together
  /// N/m: attraction, fixture and keep-out rise no steeper, so that the device can hold them
  double steepest = 1000;
  double speed_tau = 0.005;  ///< s, of the speed that parts are told by
  LearnedModel learned;      ///< by which Signal::learned tells
};
static_assert(std::is_trivially_copyable_v<AugmentationPlan>);

/// What the augmentations need to know of a tick; D, SI units.
struct AugmentationInput {
  SignalValues signals;
  std::uint32_t events = 0;
  bool allowed = true;              ///< false: this session or trial goes without
  bool rise = false, bump = false;  ///< a rise, a bump that the probe's way enters
  /// 0 to 1: height of the bump that the probe is over, or came across since the last tick, of the
  /// highest's
  double footprint = 0;
  Vec3 f_contact = Vec3::Zero(), v = Vec3::Zero(),
       dp = Vec3::Zero();  ///< dp: way since the last tick
  Vec3 up = Vec3::Zero(),
       tool = Vec3::Zero();       ///< unit: outward normal; the tool's axis toward its tip; 0: none
  Vec3 to_valley = Vec3::Zero();  ///< m, along the surface
  double valley_radius = 0;       ///< U; 0: no valley is near
  Vec3 to_line = Vec3::Zero();    ///< m, across the line; 0: none
  Vec3 out_of = Vec3::Zero();     ///< m, the way out of regions that were entered; 0: none
  double support = 1;             ///< 0 to 1, of what fades
  double dt = 0.001;
  std::int64_t now_ns = 0;
};

struct AugmentationState {
  SubtaskState subtasks;
  std::array<double, kMostAugmentations> weight{};  ///< 0 to 1
  /// s since its trigger, below 0: not triggered
  std::array<double, kMostAugmentations> elapsed{};
  std::array<double, kMostAugmentations> way{};  ///< s or m, of a vibration
  /// N, low-passed contact force; of a steadying its band's first state, m/s
  std::array<Packed3, kMostAugmentations> slow{};
  std::array<Packed3, kMostAugmentations> band{};  ///< m/s, its second
  std::uint32_t was = 0;      ///< bit i: the trigger of i was there in the last tick
  std::uint32_t started = 0;  ///< bit i: `slow` is there; bit 31: `elapsed` is
  LearnedState learned;
};
static_assert(std::is_trivially_copyable_v<AugmentationState>);

struct Augmented {
  Vec3 f = Vec3::Zero();  ///< N, on the tool
  /// N, of each, bounded with the others: they add up to `f`
  std::array<Vec3, kMostAugmentations> each = [] {
    std::array<Vec3, kMostAugmentations> none;
    none.fill(Vec3::Zero());
    return none;
  }();
  /// N, the part of `f` that heeds no motion: pulses, vibrations, reliefs. A source of its own,
  /// which the passivity observer leaves out of its account.
  Vec3 f_source = Vec3::Zero();
  std::uint32_t subtasks = 0;  ///< bit i: part i is on
  std::uint32_t active = 0;    ///< bit i: augmentation i adds a force
  std::uint32_t began = 0;     ///< bit i: triggered in this tick
};

/// Detects the parts, advances and adds the augmentations, at most `largest` together. Exactly zero
/// where it is not allowed or nothing is on. Never allocates, never throws.
Augmented augment(const AugmentationPlan& plan, const AugmentationInput& in,
                  AugmentationState* state) noexcept;

/// A (1 - cos(2 pi d / d_max)) / r, N; 0 beyond d_max. Its steepest slope is 2 pi A / (d_max r), at
/// d_max / 4.
double attractionForce(double amplitude, double d, double d_max, double radius) noexcept;
/// The amplitude that rises no steeper than `steepest` N/m, at most `amplitude`: K d_max r / (2
/// pi).
double attractionHeld(double amplitude, double d_max, double radius, double steepest) noexcept;

}  // namespace palpa::haptics
