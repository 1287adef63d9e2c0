#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "apps/assess/statistics/tests_of_means.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"

/// The score on many bodies: simulated experts who have studied a patient's pictures, and simulated
/// novices, on drawn patients of both sexes and sides, all heights and weights. About the program,
/// not about people.
namespace palpa::session {
namespace {

struct Tried {
  int successes = 0;
  std::vector<double> totals, without_time;
  double total() const { return median(totals); }
};

SessionOptions onPatient(std::uint64_t patient_seed) {
  SessionOptions options = quick(OperatorKind::expert);
  options.patient_seed = patient_seed;
  options.side = patient_seed % 2 ? anatomy::Side::left : anatomy::Side::right;
  return options;
}

Tried tries(SessionOptions options, OperatorKind who, int seeds, NeedleWorld& world) {
  options.who = who;
  options.knows_patient = who == OperatorKind::expert;
  Tried tried;
  trySeeds(options, world, seeds, [&](const task_needle::CompletedTrial& done, const auto&) {
    const assess::TrialAssessment& trial = done.assessment;
    tried.successes += trial.values.success;
    tried.totals.push_back(trial.total);
    tried.without_time.push_back(trial.total - 0.01 * trial.values.time_ms);
  });
  return tried;
}

TEST(Patients, AreScoredAlikeWhateverTheirBuild) {
  constexpr int kSeeds = 3;
  const int bodies = test::counted(1, 200);
  SessionOptions reference = onPatient(0);
  Quick<NeedleWorld> there(reference);
  const Tried usual = tries(reference, OperatorKind::expert, kSeeds, there);
  int admitted = 0, successes = 0, alike = 0, alike_without_time = 0;
  std::vector<double> experts, novices;
  for (int body = 1; body <= bodies; ++body) {
    SessionOptions options = onPatient(static_cast<std::uint64_t>(body));
    Quick<NeedleWorld> world(options);
    if (!world.not_scored.empty()) {
      std::printf("patient %d: %s\n", body, world.not_scored.c_str());
      continue;
    }
    ++admitted;
    const Tried expert = tries(options, OperatorKind::expert, kSeeds, world);
    successes += expert.successes;
    alike += expert.total() <= 1.6 * usual.total();
    const double more = median(expert.without_time) - median(usual.without_time);
    alike_without_time += more <= 60;
    experts.push_back(expert.total());
    novices.push_back(tries(options, OperatorKind::novice, 1, world).total());
    std::printf("patient %d: expert %.0f (%d of %d), without TIME %+.0f; novice %.0f\n", body,
                experts.back(), expert.successes, kSeeds, more, novices.back());
  }
  std::printf(
      "%d of %d admitted; experts succeed in %d of %d trials; reference %.0f points; within 1.6 "
      "times that: %d, without TIME within 60 points of it: %d\n",
      admitted, bodies, successes, kSeeds * admitted, usual.total(), alike, alike_without_time);
  EXPECT_GE(10 * admitted, 9 * bodies);
  EXPECT_LT(median(experts), median(novices));
  if (!test::fullCounts()) {
    EXPECT_GE(successes, kSeeds * admitted - 1);
    return;  // one body tells no share
  }
  EXPECT_GE(100 * successes, 95 * kSeeds * admitted);
  EXPECT_GE(10 * alike, 9 * admitted);
  EXPECT_GE(10 * alike_without_time, 9 * admitted);
  const statistics::TTest skill = statistics::welch(experts, novices);
  std::printf("expert %.0f, novice %.0f, p = %.2g\n", skill.mean_a, skill.mean_b,
              skill.p_two_sided);
  EXPECT_LT(skill.mean_a, skill.mean_b);
  EXPECT_LT(skill.p_two_sided, 0.01);
}

}  // namespace
}  // namespace palpa::session
