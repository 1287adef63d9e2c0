#pragma once

namespace palpa::assess {

/// From where on the six common errors of subclavian access are named (see
/// apps/assess/competence/README.md). Ours; set in the task's file under "errors".
struct ErrorRules {
  double site_off = 0.008;       ///< m, of the puncture from the taught one, across the clavicle
  double landmark_off = 0.012;   ///< m, the same along the clavicle
  double too_shallow = 0.1745;   ///< rad (10 deg), flatter than taught
  double too_cephalad = 0.1745;  ///< rad, more toward the head than taught
  double too_caudal = 0.2618;    ///< rad (15 deg): aimed below the notch, which was not found
  double aim_travel = 0.005;     ///< m that the needle must be advanced so
  double periosteum_N = 5.0;     ///< on the clavicle ...
  double periosteum_s = 0.1;     ///< ... at a stretch
  double blood_s = 0.2;          ///< plunger drawn in the lumen: the vein was reached
};

}  // namespace palpa::assess
