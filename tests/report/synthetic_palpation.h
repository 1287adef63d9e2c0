#pragma once

#include <cmath>
#include <numbers>

#include "apps/report/palpation/palpation_report.h"
#include "apps/training/trial_words.h"
#include "synthetic_report.h"

/// Made-up searches for the tests and for looking at the page.
namespace palpa::report::test {

/// Presses in vertical strips with growing gaps toward the left, a closer look at each mark, one
/// press that is too hard.
inline std::vector<assess::PalpationSample> searchedInStrips() {
  std::vector<assess::PalpationSample> samples;
  double t = 0;
  const auto press = [&](double x, double y, double force) {
    for (int i = 0; i <= 40; ++i, t += 0.01)
      samples.push_back({t, Vec3(x, y, -0.003), force * std::sin(std::numbers::pi * i / 40)});
    for (int i = 0; i < 15; ++i, t += 0.01) samples.push_back({t, Vec3(x, y, 0.003), 0});
  };
  for (int column = 0; column < 8; ++column)
    for (int row = 0; row < 9; ++row)
      press(0.034 - 0.0087 * column, (column % 2 == 0 ? 1 : -1) * (-0.034 + 0.0085 * row),
            1.45 - 0.16 * column + 0.1 * std::sin(3.0 * row));
  for (int i = 0; i < 5; ++i) press(0.019 + 0.001 * i, 0.018, 1.6 + 0.3 * i);
  return samples;
}

inline PalpationPage searchedPage(int trial) {
  PalpationPage page;
  page.samples = searchedInStrips();
  assess::PalpationFacts facts;
  facts.trial = trial;
  facts.simulated = true;
  facts.seed = 20240517;
  facts.outcome = trial == 3 ? training::Outcome::voided : training::Outcome::done;
  facts.guided = 0.25;
  const std::vector<assess::CaseLump> lumps{{Vec3(0.02, 0.018, -0.012), 0.016, 2, 1},
                                            {Vec3(-0.026, -0.02, -0.018), 0.010, 1, 2}};
  const std::vector<assess::LumpMark> marks{{21.5, Vec3(0.0225, 0.016, 0), 0.020, 2, 2},
                                            {33.0, Vec3(-0.015, 0.022, 0), 0, 0, 0},
                                            {40.0, Vec3(0.014, 0.020, 0), 0, 0, 0}};
  page.assessment = assess::assessPalpation(facts, page.rules, {}, lumps, page.samples, marks);
  return page;
}

inline PalpationReport syntheticPalpation(int trials = 1) {
  PalpationReport report;
  report.title = "Palpation of a soft phantom";
  report.trainee = "simulated novice";
  report.when = "17 May 2024, 10:42";
  report.simulated = true;
  report.force_note = "Scaled force: what was felt is a third of what a real phantom gives.";
  for (int i = 1; i <= trials; ++i) report.trials.push_back(searchedPage(i));
  report.taxonomy = {{"Fidelity", "phantom", "no anatomy of a patient"}};
  report.station = {{"Haptic device", "virtual, 7.9 N, 1 kHz", ""},
                    {"Software", "Palpa 0.1.0", ""}};
  report.notes = {{"Ticks later than 1 ms", "0 of 31 500", ""}};
  return report;
}

}  // namespace palpa::report::test
