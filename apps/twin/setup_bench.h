#pragma once

#include <cstdint>
#include <memory>

#include "anatomy/base/random.h"
#include "apps/runtime/rig.h"
#include "apps/station/station_file.h"
#include "apps/twin/bench_truth.h"
#include "apps/twin/hand_motion.h"

namespace palpa::twin {

/// How well a person does what a calibration asks. Standard deviations, [chosen] for
/// hands: braced tremor, a tip that seats in a conical hole, a pose that is met roughly.
struct SetupHandTruth {
  double seat = 0.00008;       ///< m per coordinate, where the tip comes to rest in its hole
  double jitter = 0.00003;     ///< m, of a tip pressed into its hole
  double tremor = 0.0001;      ///< m, of a tool held still in the air
  double turn_tremor = 0.002;  ///< rad
  double aim = 0.006;          ///< m, how far from where it was asked a tool or board is held
  double lean = 0.06;          ///< rad, the same for how it leans
};

/// Where a simulated person's hand truly has the tool while a request is carried out: there with
/// minimum jerk, then what was asked. A pure function of time within a request; tremor is drawn
/// step by step.
class SetupMotion {
 public:
  SetupMotion(const SetupHandTruth& hand, std::uint64_t seed);

  /// Begins at `t`: `X_WT` is the tool (z along the needle) now, `p_W` where the hole truly is.
  /// `p_W` of a sample: on its top, `X_WP` its frame.
  void begin(const runtime::Request& request, const Pose& X_WT, const Vec3& p_W, double t,
             const Pose& X_WP = Pose::Identity());
  /// The tool `dt` after the last call.
  Pose step(double t, double dt);
  /// The person says "now".
  bool pressing(double t) const;

 private:
  Pose during(double t) const;
  LedTip wayOver(const Vec3& p_P);
  LedTip touchOnce(const Vec3& place);

  SetupHandTruth hand_;
  RandomStream choices_, jitter_;
  Tremor tremor_, turn_tremor_;
  runtime::Request request_;
  MinJerk approach_;
  Pose X_WT_ = Pose::Identity();  ///< asked for, as it is met
  double arrives_ = 0;
  Vec3 wave_phase_ = Vec3::Zero();
  Pose X_WP_ = Pose::Identity();
  LedTip felt_{Vec3::Zero()};  ///< over a sample, in P
};

/// The virtual bench while it is set up: the same truth as in a session of the same seed, and a
/// simulated person who does what a calibration asks, about as well as people do. In virtual time:
/// a moment passes with every call of next().
class SetupBench final : public runtime::Rig {
 public:
  SetupBench(const station::Station& station, std::uint64_t seed);
  ~SetupBench() override;

  void ask(const runtime::Request& request) override;
  std::optional<runtime::RigMoment> next() override;

  const WorldTruth& truth() const;  ///< for reports on accuracy only
  const calibration::CameraModel& trueCamera() const;
  const DeviceTruth& device() const;
  Pose X_CW() const;  ///< of the boom

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::twin
