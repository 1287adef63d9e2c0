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
  const TaughtPath taught = path.onBody(lineOf(truth));
  // 4 standard errors of a mean of 150; sd of an sd: sd / sqrt(2 n), 4 of them, and up to 5 %
  // because the tails of the normal distribution are left out.
  const double n = std::sqrt(150.0);
  EXPECT_LT((taught.entry_L - truth.entry).norm(), 4 * truth.entry_sd * std::sqrt(2) / n);
  EXPECT_NEAR(path.depth, truth.depth, 4 * truth.depth_sd / n);
  EXPECT_LT(angle(taught.direction_L, truth.direction), 4 * truth.direction_sd * std::sqrt(2) / n);
  EXPECT_NEAR(path.entry_sd / truth.entry_sd, 1, 4 / (std::sqrt(2.0) * n) + 0.05);
  EXPECT_NEAR(path.depth_sd / truth.depth_sd, 1, 4 / (std::sqrt(2.0) * n) + 0.05);
  EXPECT_NEAR(path.direction_sd / truth.direction_sd, 1, 4 / (std::sqrt(2.0) * n) + 0.05);
  EXPECT_DOUBLE_EQ(path.direction_acceptable, 2 * path.direction_sd);
  EXPECT_DOUBLE_EQ(path.entry_acceptable, 2 * path.entry_sd);
  EXPECT_DOUBLE_EQ(path.depth_acceptable, 2 * path.depth_sd);
  EXPECT_DOUBLE_EQ(path.line_acceptable, 2 * path.line_sd);
  EXPECT_EQ(path.experts, (std::vector<std::string>{"A", "B", "C"}));
  EXPECT_EQ(path.trials + path.left_out, 150);
  EXPECT_LE(path.left_out, 7);  // 0.2-0.3 % in five looks at 150: 2 expected
}

TEST(FitExpertPath, LineRunsFromMeanStartToMeanEnd) {
  const Truth truth;
  const TaughtPath taught = fitExpertPath(drawTrials(truth)).onBody(lineOf(truth));
  const Vec3 start = truth.entry + Vec3(0, truth.depth, 0);
  EXPECT_LT((taught.line_from_L - start).norm(), 0.001);
  EXPECT_LT((taught.line_to_L - start - truth.length * truth.direction).norm(), 0.0015);
}

TEST(FitExpertPath, IdenticalTrialsHaveNoSpreadAndTheLeastAcceptance) {
  Truth truth;
  truth.entry_sd = truth.depth_sd = truth.direction_sd = 0;
  const ExpertPath path = fitExpertPath(drawTrials(truth));
  EXPECT_EQ(path.trials, 150);
  EXPECT_NEAR(path.entry_sd, 0, 1e-12);
  EXPECT_NEAR(path.direction_sd, 0, 1e-7);
  EXPECT_DOUBLE_EQ(path.direction_acceptable, 2 * kDeg);
  EXPECT_NEAR(path.line_sd, 0, 1e-12);
  for (const double least : {path.entry_acceptable, path.depth_acceptable, path.line_acceptable})
    EXPECT_DOUBLE_EQ(least, 0.001);
}

TEST(FitExpertPath, GrossOutliersAreLeftOutCountedAndDoNotMoveTheMean) {
  std::vector<ExpertTrial> trials = drawTrials({});
  const ExpertPath clean = fitExpertPath(trials);
  for (int i = 0; i < 12; ++i) {  // 4 of each expert, registration lost
    ExpertTrial& bad = trials[static_cast<std::size_t>(12 * i + 1)];
    for (Vec3* p_L : {&bad.entry_L, &bad.start_L, &bad.end_L}) *p_L += Vec3(0.08, 0, 0.05);
    bad.direction_L = -bad.direction_L;
  }
  const ExpertPath path = fitExpertPath(trials);
  EXPECT_GE(path.left_out, 12);
  EXPECT_LE(path.left_out, 12 + 7);
  EXPECT_LT((path.entry - clean.entry).norm(), 2e-4);
  EXPECT_LT(angle(path.direction, clean.direction), 0.2 * kDeg);
}

TEST(FitExpertPath, OrderOfTrialsDoesNotMatterBeyondRounding) {
  std::vector<ExpertTrial> trials = drawTrials({});
  const ExpertPath path = fitExpertPath(trials);
  std::reverse(trials.begin(), trials.end());
  const ExpertPath reversed = fitExpertPath(trials);
  EXPECT_LT((path.entry - reversed.entry).norm(), 1e-15);
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
  trials[149].end_L = trials[149].start_L;
  EXPECT_NE(complaint(trials).find("trial 150 of expert C"), std::string::npos);
}

/// Another build: turned, with a longer way to a vein that lies steeper under the skin.
TeachingLine anotherBody() {
  TeachingLine line;
  line.entry_L = {0.012, -0.030, -0.004};
  line.inward_L = Vec3(0.2, 0.95, -0.15).normalized();
  line.target_L = line.entry_L + Vec3(0.036, 0.026, 0.017);
  return line;
}

/// The same technique on any body, told in the axes of its own line.
ExpertTrial performedOn(const TeachingLine& line, const Vec3& entry_off, const Vec3& end_off) {
  ExpertTrial trial;
  trial.expert = "A";
  trial.line = line;
  trial.depth = 0.009;
  trial.entry_L = line.entry_L + axesOf(line) * entry_off;
  trial.start_L = trial.entry_L + trial.depth * line.inward_L;
  trial.end_L = line.target_L + axesOf(line) * end_off;
  trial.direction_L = (trial.end_L - trial.start_L).normalized();
  return trial;
}

TEST(FitExpertPath, IsOfTheTechniqueNotOfTheBodies) {
  const auto fitOn = [&](const TeachingLine& one, const TeachingLine& other) {
    Normal draw(11);
    std::vector<ExpertTrial> trials;
    for (int i = 0; i < 100; ++i)
      trials.push_back(performedOn(i % 2 ? one : other, {draw(0.001), 0, draw(0.001)},
                                   {0, draw(0.0005), draw(0.0005)}));
    return fitExpertPath(trials);
  };
  const TeachingLine here = lineOf({}), there = anotherBody();
  const ExpertPath mixed = fitOn(here, there), plain = fitOn(here, here);
  EXPECT_LT((mixed.entry - plain.entry).norm(), 1e-4);
  EXPECT_NEAR(mixed.entry_sd / plain.entry_sd, 1, 0.05);
  EXPECT_NEAR(mixed.direction_sd / plain.direction_sd, 1, 0.25) << "longer ways: smaller angles";
  EXPECT_LT(angle(mixed.direction, plain.direction), 0.2 * kDeg);
  EXPECT_LT((mixed.line_to - plain.line_to).norm(), 1e-4);
}

TEST(TaughtPath, EndsInTheVeinOfEveryBody) {
  std::vector<ExpertTrial> trials;
  for (int i = 0; i < 30; ++i) {
    trials.push_back(performedOn(lineOf({}), {1e-3 * (i % 5 - 2), 0, 0}, Vec3::Zero()));
  }
  const ExpertPath path = fitExpertPath(trials);
  for (const TeachingLine& body : {lineOf({}), anotherBody()}) {
    const TaughtPath taught = path.onBody(body);
    EXPECT_LT((taught.entry_L - body.entry_L).norm(), 1e-9);
    EXPECT_LT((taught.line_to_L - body.target_L).norm(), 1e-9);
    const Vec3 way = body.target_L - body.entry_L - path.depth * body.inward_L;
    EXPECT_LT(angle(taught.direction_L, way), 0.1 * kDeg);
    EXPECT_EQ(taught.depth, path.depth);
    EXPECT_EQ(taught.direction_acceptable, path.direction_acceptable);
  }
}

TEST(TeachingLine, RefusesAWayThatHasNoDirection) {
  TeachingLine line = anotherBody();
  line.target_L = line.entry_L + 0.004 * Vec3::UnitX();
  EXPECT_THROW(axesOf(line), Error);
  line.target_L = line.entry_L + 0.040 * line.inward_L;
  EXPECT_THROW(axesOf(line), Error);
  line.target_L = Vec3(NAN, 0, 0);
  EXPECT_THROW(axesOf(line), Error);
}

}  // namespace
}  // namespace palpa::calibration::test
