#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "apps/twin/device_twin.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/phantom/opposed_phantom.h"
#include "apps/twin/phantom/phantom_twin.h"
#include "haptics/sensors/reaction_filter.h"
#include "haptics/sensors/wrench_filter.h"

namespace palpa::bench {

/// How the phantom is felt: as it is, or through a device's encoders and a force sensor that
/// carries a tool; then cleared of noise by a low-pass or by a Kalman filter.
enum class Noise { none, low_passed, kalman };
const char* nameOf(Noise noise);     ///< "none", "realistic"
const char* clearedBy(Noise noise);  ///< "nothing", "low-pass", "kalman"

/// A tool's tip and the reaction on it, as a station knows them: a device's encoders; a sensor on
/// its last link that carries the tool, whose mass was identified to 1 % and whose bias to 5 mN
/// [chosen]. Both through one low-pass, so that they are late by the same; or by a Kalman filter,
/// which is not late.
class SensedTouch {
 public:
  explicit SensedTouch(std::uint64_t seed, const twin::DeviceTruth& device = {},
                       Noise noise = Noise::low_passed);
  /// The next tick: measured tip, m, and reaction, N, in P. The tool stands upright.
  std::pair<Vec3, Vec3> feel(const Vec3& true_tip, const Vec3& f_touch, double dt);

 private:
  twin::DeviceTruth device_;
  twin::SensorTwin sensor_;
  bool kalman_;
  haptics::WrenchFilter filter_;
  haptics::WrenchFilterState state_;
  haptics::ReactionFilter reaction_;
  haptics::ReactionState reaction_state_;
  std::int64_t t_ns_ = 0;
};

/// Two tools that keep side by side along x, `apart` from each other, the first beyond: led to the
/// same places in the same time, each to its own depth, m. They start above the surface.
class LedPair {
 public:
  LedPair(double shift, double apart);
  /// `shift`: of the middle between them.
  LedPair& go(double shift, const std::array<double, 2>& depths, double seconds, double hold = 0);
  double duration() const { return tips_[0].duration(); }
  std::array<Vec3, 2> at(double t) const { return {tips_[0].at(t), tips_[1].at(t)}; }

 private:
  double half_;
  std::array<twin::LedTip, 2> tips_;
};

/// One tick on a simulated phantom.
struct PhantomTick {
  Vec3 tip = Vec3::Zero(), dp = Vec3::Zero();  ///< m, as measured
  /// N, reaction on the tool, as measured: without the tool's weight and inertia
  Vec3 f_r = Vec3::Zero();
  Vec3 true_tip = Vec3::Zero();  ///< for the judge only
  twin::PhantomTouch truth;      ///< for the judge only
};

inline constexpr double kPhantomTick = 1e-3;  ///< s

/// What one tool feels, tick after tick.
class TouchRecorder {
 public:
  TouchRecorder(Noise noise, std::uint64_t seed) : noise_(noise), sensed_(seed, {}, noise) {}
  PhantomTick record(const Vec3& true_tip, const twin::PhantomTouch& truth);

 private:
  Noise noise_;
  SensedTouch sensed_;
  std::optional<Vec3> before_;
};

/// The tip led over a phantom. Position and force pass the same low-pass where there is noise, and
/// are late by the same.
std::vector<PhantomTick> recordTouch(twin::PhantomTwin phantom, const twin::LedTip& tip,
                                     Noise noise, std::uint64_t seed);
std::vector<std::array<PhantomTick, 2>> recordTouches(twin::PhantomPairTwin phantom,
                                                      const LedPair& tips, Noise noise,
                                                      std::uint64_t seed);
/// Of a slab between two tools: both tips are led as if from above. The second's is mirrored about
/// the slab's middle plane, with all that its sensor feels but is recorded as it is, in P.
std::vector<std::array<PhantomTick, 2>> recordOpposed(twin::OpposedPhantomTwin phantom,
                                                      const std::array<twin::LedTip, 2>& tips,
                                                      Noise noise, std::uint64_t seed);

}  // namespace palpa::bench
