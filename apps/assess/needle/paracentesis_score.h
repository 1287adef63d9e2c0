#pragma once

#include <algorithm>
#include <cmath>

namespace palpa::assess {

/// What is counted in a trial of subclavian paracentesis. Higher is worse.
/// Source: Tzafestas et al., Presence 17(2), 2008, tables 1 and 2.
struct ParacentesisValues {
  double col_lung = 0;  ///< scoring samples (20 Hz) in contact with the lung
  /// ... with ribs and skeleton, guiding contact with the clavicle left out, in the rules' BoneUnit
  double col_rib = 0;
  double col_art = 0;    ///< ... with arteries
  double col_vein = 0;   ///< ... with the vein, other than the successful entry and aspiration
  double phase_1 = 0;    ///< mm: entry point's distance from the optimum plus depth error
  double phase_2 = 0;    ///< 1000 x deviation of orientation / acceptable deviation
  double econ_mean = 0;  ///< mm: mean distance of tip and shaft from the optimal line, phase 2
  double econ_var = 0;   ///< mm^2: variance of the same
  double time_ms = 0;
  bool success = false;
};

/// What one of COL_RIB is. The source says "contacts"; its sample row has 25 of them in a trial of
/// 158 s, a third of the total.
enum class BoneUnit : unsigned char {
  samples,  ///< a scoring sample in contact: 20 of them for each second of leaning on a bone
  contacts  ///< a contact, and one more for each full second that it lasts
};

/// Between the printed steps of PHASE_2's weight.
enum class Phase2Weight : unsigned char {
  steps,  ///< as published: points jump by 200 at 1000 and by 400 at 2000
  /// rising in a straight line from `low` at 1000 to `high` at 2000; no jump, and with the usual
  /// weights the printed one at 1500 and from 2000 on
  continuous
};

struct ScoreWeights {
  double lung = 500, rib = 50, artery = 50, vein = 10, phase_1 = 2;
  double phase_2_low = 0, phase_2_middle = 0.2,
         phase_2_high = 0.4;  ///< below 1000, below 2000, from 2000
  Phase2Weight phase_2 = Phase2Weight::steps;
  double econ_mean = 2, econ_var = 20, time = 0.01;

  double phase2Weight(double value) const {
    if (phase_2 == Phase2Weight::continuous)
      return std::lerp(phase_2_low, phase_2_high, std::clamp(value / 1000 - 1, 0.0, 1.0));
    return value < 1000 ? phase_2_low : value < 2000 ? phase_2_middle : phase_2_high;
  }
};

/// Total penalty: sum of weight x value.
double total(const ParacentesisValues& values, const ScoreWeights& weights = {});

}  // namespace palpa::assess
