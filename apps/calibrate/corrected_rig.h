#pragma once

#include "apps/runtime/rig.h"
#include "calibration/workspace_map.h"
#include "haptics/workspace_correction.h"

namespace palpa::calibrate {

/// A rig whose readings are put right by a calibration of the workspace, from the moment on when
/// there is one.
class CorrectedRig final : public runtime::Rig {
 public:
  explicit CorrectedRig(runtime::Rig& rig) : rig_(rig) {}
  void correctBy(const haptics::WorkspaceCorrection& correction) { correction_ = correction; }
  void correctBy(const calibration::WorkspaceMap& map) { correction_ = asCorrection(map); }

  void ask(const runtime::Request& request) override { rig_.ask(request); }
  std::optional<runtime::Moment> next() override {
    std::optional<runtime::Moment> moment = rig_.next();
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

}  // namespace palpa::calibrate
