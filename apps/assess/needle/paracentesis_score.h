#pragma once

namespace palpa::assess {

/// What is counted in a trial of subclavian paracentesis. Higher is worse.
/// Source: Tzafestas et al., Presence 17(2), 2008, tables 1 and 2.
struct ParacentesisValues {
  double col_lung = 0;   ///< scoring samples (20 Hz) in contact with the lung
  double col_rib = 0;    ///< ... with ribs and skeleton, guiding contact with the clavicle left out
  double col_art = 0;    ///< ... with arteries
  double col_vein = 0;   ///< ... with the vein, other than the successful entry and aspiration
  double phase_1 = 0;    ///< mm: entry point's distance from the optimum plus depth error
  double phase_2 = 0;    ///< 1000 x deviation of orientation / acceptable deviation
  double econ_mean = 0;  ///< mm: mean distance of tip and shaft from the optimal line, phase 2
  double econ_var = 0;   ///< mm^2: variance of the same
  double time_ms = 0;
  bool success = false;
};

struct ScoreWeights {
  double lung = 500, rib = 50, artery = 50, vein = 10, phase_1 = 2;
  double phase_2_low = 0, phase_2_middle = 0.2,
         phase_2_high = 0.4;  ///< below 1000, below 2000, from 2000
  double econ_mean = 2, econ_var = 20, time = 0.01;

  double phase2Weight(double value) const {
    return value < 1000 ? phase_2_low : value < 2000 ? phase_2_middle : phase_2_high;
  }
};

/// Total penalty: sum of weight x value.
double total(const ParacentesisValues& values, const ScoreWeights& weights = {});

}  // namespace palpa::assess
