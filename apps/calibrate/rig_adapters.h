#pragma once

#include <functional>
#include <utility>

#include "apps/runtime/rig.h"
#include "calibration/registration.h"
#include "haptics/loop/workspace_correction.h"

namespace palpa::calibrate {

/// A rig whose readings are put right by a calibration of the workspace, from the moment on when
/// there is one.
class CorrectedRig final : public runtime::Rig {
 public:
  explicit CorrectedRig(runtime::Rig& rig) : rig_(rig) {}
  void correctBy(const haptics::WorkspaceCorrection& correction) { correction_ = correction; }
  void correctBy(const calibration::WorkspaceMap& map) { correction_ = asCorrection(map); }

  void ask(const runtime::Request& request) override { rig_.ask(request); }
  std::optional<runtime::RigMoment> next() override {
    std::optional<runtime::RigMoment> moment = rig_.next();
    if (moment && moment->reading && correction_.order > 0)
      moment->reading->p_DE = haptics::corrected(correction_, moment->reading->p_DE);
    return moment;
  }

  static haptics::WorkspaceCorrection asCorrection(const calibration::WorkspaceMap& map) {
    haptics::WorkspaceCorrection c;
    c.order = map.order;
    c.centre = pack(map.centre_D);
    c.half = pack(map.half_D);
    for (Eigen::Index k = 0; k < map.coefficients.rows(); ++k)
      c.coefficients[static_cast<std::size_t>(k)] = pack(Vec3(map.coefficients.row(k)));
    return c;
  }

 private:
  runtime::Rig& rig_;
  haptics::WorkspaceCorrection correction_;
};

/// A rig whose pictures somebody else sees, too, as they are taken.
class WatchedRig final : public runtime::Rig {
 public:
  using See = std::function<void(const ar::Frame&)>;
  WatchedRig(runtime::Rig& rig, See see) : rig_(rig), see_(std::move(see)) {}

  void ask(const runtime::Request& request) override { rig_.ask(request); }
  std::optional<runtime::RigMoment> next() override {
    std::optional<runtime::RigMoment> moment = rig_.next();
    if (moment && moment->picture)
      moment->picture = [this, take = std::move(moment->picture)] {
        std::optional<ar::Frame> frame = take();
        if (frame) see_(*frame);
        return frame;
      };
    return moment;
  }

 private:
  runtime::Rig& rig_;
  const See see_;
};

}  // namespace palpa::calibrate
