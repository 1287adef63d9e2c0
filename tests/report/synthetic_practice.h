#pragma once

#include <cmath>

#include "anatomy/base/random.h"
#include "apps/report/practice/practice_reports.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

namespace palpa::report::test {

/// A made-up needle trial of somebody who gets better: seeded, nobody's. Its total is what the
/// usual weights give.
inline progress::PracticeTrial madeUpTrial(const std::string& trainee, int n, RandomStream& random,
                                           double skill) {
  const double left = std::exp(-(n - 1) / 6.0), wild = (0.15 + left) / skill;
  progress::PracticeTrial t;
  t.trainee = trainee;
  t.task = "paracentesis";
  t.engine = training::Engine::needle;
  t.arrival = 1 + (n - 1) / 5;
  t.number = 1 + (n - 1) % 5;
  t.started_utc = n <= 15 ? "2027-01-1" + std::to_string((n - 1) / 5) + "T09:00:00Z"
                          : "2027-07-1" + std::to_string((n - 1) / 5 % 9) + "T09:00:00Z";
  t.role = training::Role::scored;
  const double time = 20 + 45 * left + 4 * random.openUniform(),
               lung = random.openUniform() < 0.5 * wild ? std::ceil(4 * random.openUniform()) : 0,
               rib = random.openUniform() < wild ? std::ceil(9 * random.openUniform()) : 0;
  const double vein = std::floor(4 * random.openUniform()),
               phase_1 = 3 + 8 * wild * random.openUniform(),
               phase_2 = 500 + 900 * wild * random.openUniform(), mean = 2 + 3 * wild,
               variance = 2 + 9 * wild * random.openUniform();
  const bool success = random.openUniform() > 0.6 * wild;
  t.outcome = success ? training::Outcome::success : training::Outcome::aborted;
  const double direction = phase_2 < 1000 ? 0 : 0.2 * phase_2;
  const double passes = 1 + std::floor(4 * wild * random.openUniform());
  t.figures = {{"success", success ? 1.0 : 0.0},
               {"time_s", time},
               {"total", 500 * lung + 50 * rib + 10 * vein + 2 * phase_1 + direction + 2 * mean +
                             20 * variance + 10 * time},
               {"col_lung", lung},
               {"col_rib", rib},
               {"col_artery", 0},
               {"col_vein", vein},
               {"phase_1_mm", phase_1},
               {"phase_2", phase_2},
               {"econ_mean_mm", mean},
               {"econ_var_mm2", variance},
               {"needle_passes", passes},
               {"first_pass_success", success && passes == 1 ? 1.0 : 0.0},
               {"back_wall_punctures", random.openUniform() < 0.2 ? 1.0 : 0.0},
               {"over_force_s", 0},
               {"tissue_time_s", 0.5 * time},
               {"translational_actions", 3 + 6 * wild},
               {"rotational_actions", 2 + 4 * wild},
               {"speed_at_vein_mm_s", 3 + 8 * wild},
               {"closest_pleura_mm", lung > 0 ? -1 : 2 + 7 * random.openUniform()},
               {"closest_pleura_at_s", 0.7 * time},
               {"closest_artery_mm", 1 + 6 * random.openUniform()},
               {"closest_artery_at_s", 0.8 * time}};
  return t;
}

inline TraineeReport madeUpTrainee(int trials, std::uint64_t seed = 5, double skill = 1) {
  TraineeReport report;
  report.trainee = "T<7>";
  report.group = "novice";
  report.experience = "3rd year";
  report.made_utc = "2027-08-01T10:00:00Z";
  report.software = "palpa test";
  RandomStream random = RandomStream::ofSeed(seed);
  for (int n = 1; n <= trials; ++n)
    report.trials.push_back(madeUpTrial(report.trainee, n, random, skill));
  return report;
}

inline CohortReport madeUpCohort(int trainees, int trials) {
  CohortReport report;
  report.group = "novice";
  report.made_utc = "2027-08-01T10:00:00Z";
  for (int i = 0; i < trainees; ++i) {
    RandomStream random = RandomStream::ofSeed(static_cast<std::uint64_t>(i) + 40);
    char name[16];
    std::snprintf(name, sizeof name, "T%03d", i + 1);
    for (int n = 1; n <= trials; ++n)
      report.trials.push_back(madeUpTrial(name, n, random, i == 2 ? 0.35 : 1 + 0.3 * i));
  }
  return report;
}

}  // namespace palpa::report::test
