#include <gtest/gtest.h>

#include <limits>

#include "anatomy/base/error.h"
#include "tests/expert_path/trials.h"

namespace palpa::calibration::test {
namespace {

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

std::string complaint(const std::vector<ExpertTrial>& trials, int least = 20) {
  try {
    fitExpertPath(trials, least);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FitExpertPath, FindsMeanAndSpreadOfManyTrials) {
  const Truth truth;
  const ExpertPath path = fitExpertPath(drawTrials(truth));
  // 4 standard errors of a mean of 150; sd of an sd: sd / sqrt(2 n), 4 of them, and up to 5 %
  // because the tails of the normal distribution are left out.
  const double n = std::sqrt(150.0);
  EXPECT_LT((path.entry_L - truth.entry).norm(), 4 * truth.entry_sd * std::sqrt(2) / n);
  EXPECT_NEAR(path.depth, truth.depth, 4 * truth.depth_sd / n);
  EXPECT_LT(angle(path.direction_L, truth.direction), 4 * truth.direction_sd * std::sqrt(2) / n);
  EXPECT_NEAR(path.entry_sd / truth.entry_sd, 1, 4 / (std::sqrt(2.0) * n) + 0.05);
  EXPECT_NEAR(path.depth_sd / truth.depth_sd, 1, 4 / (std::sqrt(2.0) * n) + 0.05);
  EXPECT_NEAR(path.direction_sd / truth.direction_sd, 1, 4 / (std::sqrt(2.0) * n) + 0.05);
  EXPECT_DOUBLE_EQ(path.direction_acceptable, 2 * path.direction_sd);
  EXPECT_EQ(path.experts, (std::vector<std::string>{"A", "B", "C"}));
  EXPECT_EQ(path.trials + path.left_out, 150);
  EXPECT_LE(path.left_out, 7);  // 0.2-0.3 % in five looks at 150: 2 expected
}

TEST(FitExpertPath, LineRunsFromMeanStartToMeanEnd) {
  const Truth truth;
  const ExpertPath path = fitExpertPath(drawTrials(truth));
  const Vec3 start = truth.entry + Vec3(0, truth.depth, 0);
  EXPECT_LT((path.line_from_L - start).norm(), 0.001);
  EXPECT_LT((path.line_to_L - start - truth.length * truth.direction).norm(), 0.0015);
}

TEST(FitExpertPath, IdenticalTrialsHaveNoSpreadAndTheLeastAcceptance) {
  Truth truth;
  truth.entry_sd = truth.depth_sd = truth.direction_sd = 0;
  const ExpertPath path = fitExpertPath(drawTrials(truth));
  EXPECT_EQ(path.trials, 150);
  EXPECT_NEAR(path.entry_sd, 0, 1e-12);
  EXPECT_NEAR(path.direction_sd, 0, 1e-7);
  EXPECT_DOUBLE_EQ(path.direction_acceptable, 2 * kDeg);
}

TEST(FitExpertPath, GrossOutliersAreLeftOutCountedAndDoNotMoveTheMean) {
  std::vector<ExpertTrial> trials = drawTrials({});
  const ExpertPath clean = fitExpertPath(trials);
  for (int i = 0; i < 12; ++i) {  // 4 of each expert, registration lost
    ExpertTrial& bad = trials[static_cast<std::size_t>(12 * i + 1)];
    bad.entry_L += Vec3(0.08, 0, 0.05);
    for (Vec3& p : bad.tip_L) p += Vec3(0.08, 0, 0.05);
    bad.direction_L = -bad.direction_L;
  }
  const ExpertPath path = fitExpertPath(trials);
  EXPECT_GE(path.left_out, 12);
  EXPECT_LE(path.left_out, 12 + 7);
  EXPECT_LT((path.entry_L - clean.entry_L).norm(), 2e-4);
  EXPECT_LT(angle(path.direction_L, clean.direction_L), 0.2 * kDeg);
}

TEST(FitExpertPath, OrderOfTrialsDoesNotMatterBeyondRounding) {
  std::vector<ExpertTrial> trials = drawTrials({});
  const ExpertPath path = fitExpertPath(trials);
  std::reverse(trials.begin(), trials.end());
  const ExpertPath reversed = fitExpertPath(trials);
  EXPECT_LT((path.entry_L - reversed.entry_L).norm(), 1e-15);
  EXPECT_EQ(path.left_out, reversed.left_out);
}

TEST(FitExpertPath, AnExpertWithAnotherTechniqueIsRefusedNotDropped) {
  std::vector<ExpertTrial> trials = drawTrials({});
  for (ExpertTrial& trial : trials)
    if (trial.expert == "C") trial.entry_L += Vec3(0.03, 0, 0);
  EXPECT_NE(complaint(trials).find("of expert C"), std::string::npos) << complaint(trials);
}

TEST(FitExpertPath, RefusesWhenExpertsDisagree) {
  Truth truth;
  truth.direction_sd = 14 * kDeg;
  EXPECT_NE(complaint(drawTrials(truth)).find("disagree on the direction"), std::string::npos);
  truth = {};
  truth.entry_sd = 0.013;
  EXPECT_NE(complaint(drawTrials(truth)).find("disagree on the entry"), std::string::npos);
}

TEST(FitExpertPath, RefusesTooFewTrials) {
  EXPECT_NE(complaint(drawTrials({}, 6)).find("at least 20 are needed"), std::string::npos);
  EXPECT_EQ(complaint(drawTrials({}, 6), 15), "");
  EXPECT_NE(complaint({}, 0).find("0 usable trials"), std::string::npos);
}

TEST(FitExpertPath, RefusesTrialsThatAreNoTrialsAndNamesThem) {
  const std::vector<ExpertTrial> good = drawTrials({});
  std::vector<ExpertTrial> trials = good;
  trials[3].depth = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(complaint(trials).find("trial 4 of expert A"), std::string::npos);
  trials = good;
  trials[60].direction_L = Vec3::Zero();
  EXPECT_NE(complaint(trials).find("trial 61 of expert B"), std::string::npos);
  trials = good;
  trials[149].tip_L.clear();
  EXPECT_NE(complaint(trials).find("trial 150 of expert C"), std::string::npos);
}

}  // namespace
}  // namespace palpa::calibration::test
