#pragma once

#include <memory>

#include "apps/runtime/rig.h"
#include "apps/station/station_file.h"
#include "apps/twin/bench_truth.h"

namespace palpa::twin {

/// The virtual bench while it is set up: the same truth as in a session of the same seed, and a
/// simulated person who does what a calibration asks, about as well as people do. In virtual time:
/// a moment passes with every call of next().
class SetupBench final : public runtime::Rig {
 public:
  SetupBench(const station::Station& station, std::uint64_t seed);
  ~SetupBench() override;

  void ask(const runtime::Request& request) override;
  std::optional<runtime::Moment> next() override;

  const WorldTruth& truth() const;  ///< for reports on accuracy only
  const calibration::CameraModel& trueCamera() const;
  const DeviceTruth& device() const;
  Pose X_CW() const;  ///< of the boom

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::twin
