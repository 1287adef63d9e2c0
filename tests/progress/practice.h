#pragma once

#include "apps/assess/progress/history.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

namespace palpa::progress::test {

/// A needle's trial without a fault: 20 s, 300 points.
inline PracticeTrial cleanTrial(const std::string& trainee, int number,
                                const std::string& day = "2027-01-10T09:00:00Z") {
  PracticeTrial t;
  t.trainee = trainee;
  t.task = "paracentesis";
  t.engine = training::Engine::needle;
  t.started_utc = day;
  t.arrival = 1;
  t.number = number;
  t.role = training::Role::scored;
  t.outcome = training::Outcome::success;
  t.figures = {{"success", 1},
               {"time_s", 20},
               {"total", 200 + 2.0 * 5 + 2 * 3 + 20 * 4},
               {"col_lung", 0},
               {"col_rib", 0},
               {"col_artery", 0},
               {"col_vein", 0},
               {"phase_1_mm", 5},
               {"phase_2", 400},
               {"econ_mean_mm", 3},
               {"econ_var_mm2", 4},
               {"needle_passes", 1},
               {"back_wall_punctures", 0},
               {"over_force_s", 0},
               {"tissue_time_s", 12},
               {"closest_pleura_mm", 9},
               {"closest_pleura_at_s", 11}};
  return t;
}

inline void set(PracticeTrial& trial, const std::string& metric, double value) {
  trial.figures.set(metric, value);
}

}  // namespace palpa::progress::test
