// Two published fits of lme (Pinheiro and Bates, "Mixed-Effects Models in S and S-PLUS", Springer
// 2000) with their data, and laws.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/assess/statistics/mixed_model.h"
#include "apps/assess/statistics/tests_of_means.h"

namespace palpa::statistics {
namespace {

struct Trials {
  Eigen::VectorXd y;
  Eigen::MatrixXd x;
  std::vector<int> subject;
};

/// Travel time of ultrasonic waves in six rails (Devore 2000; Pinheiro and Bates, section 1.1).
Trials rails() {
  const std::vector<double> times{55, 53,  54, 26, 37, 32, 78, 91, 85,
                                  92, 100, 96, 49, 51, 50, 80, 85, 83};
  Trials t{Eigen::Map<const Eigen::VectorXd>(times.data(), 18), Eigen::MatrixXd::Ones(18, 1), {}};
  for (int i = 0; i < 18; ++i) t.subject.push_back(i / 3);
  return t;
}

/// Distance from pituitary gland to pterygomaxillary fissure at 8, 10, 12, 14 years, 16 boys and 11
/// girls (Potthoff and Roy, Biometrika 51, 1964).
Trials jaws(bool interaction) {
  const std::vector<std::vector<double>> children{
      {26, 25, 29, 31},       {21.5, 22.5, 23, 26.5}, {23, 22.5, 24, 27.5}, {25.5, 27.5, 26.5, 27},
      {20, 23.5, 22.5, 26},   {24.5, 25.5, 27, 28.5}, {22, 22, 24.5, 26.5}, {24, 21.5, 24.5, 25.5},
      {23, 20.5, 31, 26},     {27.5, 28, 31, 31.5},   {23, 23, 23.5, 25},   {21.5, 23.5, 24, 28},
      {17, 24.5, 26, 29.5},   {22.5, 25.5, 25.5, 26}, {23, 24.5, 26, 30},   {22, 21.5, 23.5, 25},
      {21, 20, 21.5, 23},     {21, 21.5, 24, 25.5},   {20.5, 24, 24.5, 26}, {23.5, 24.5, 25, 26.5},
      {21.5, 23, 22.5, 23.5}, {20, 21, 21, 22.5},     {21.5, 22.5, 23, 25}, {23, 23, 23.5, 24},
      {20, 21, 22, 21.5},     {16.5, 19, 19, 19.5},   {24.5, 25, 28, 28}};
  Trials t{Eigen::VectorXd(108), Eigen::MatrixXd::Ones(108, interaction ? 4 : 3), {}};
  for (int i = 0; i < 108; ++i) {
    t.y[i] = children[static_cast<std::size_t>(i / 4)][static_cast<std::size_t>(i % 4)];
    t.x(i, 1) = 8 + 2 * (i % 4);
    t.x(i, 2) = i / 4 >= 16;
    if (interaction) t.x(i, 3) = t.x(i, 1) * t.x(i, 2);
    t.subject.push_back(i / 4);
  }
  return t;
}

TEST(MixedModel, OfRailsIsThePublishedOne) {
  const Trials t = rails();
  const MixedModel m = fitMixedModel(t.y, t.x, {"mean"}, t.subject);
  EXPECT_NEAR(m.effects[0].estimate, 66.5, 1e-9);
  EXPECT_NEAR(m.effects[0].error, 10.17104, 5e-5);
  EXPECT_NEAR(m.sd_subject, 24.80547, 5e-5);
  EXPECT_NEAR(m.sd_residual, 4.020779, 5e-6);
  EXPECT_NEAR(m.log_likelihood, -61.0885, 5e-5);
  EXPECT_EQ(m.effects[0].degrees, 5);
  EXPECT_EQ(m.subjects, 6u);
}

/// Balanced and without columns of its own, REML is the analysis of variance: sd_subject^2 = (MSB -
/// MSW) / n.
TEST(MixedModel, OfRailsIsTheAnalysisOfVariance) {
  const Trials t = rails();
  const MixedModel m = fitMixedModel(t.y, t.x, {"mean"}, t.subject);
  double between = 0, within = 0;
  for (int r = 0; r < 6; ++r) {
    const Eigen::Vector3d rail = t.y.segment<3>(3 * r);
    between += 3 * std::pow(rail.mean() - 66.5, 2) / 5;
    within += (rail.array() - rail.mean()).square().sum() / 12;
  }
  EXPECT_NEAR(m.sd_residual * m.sd_residual, within, 1e-5);
  EXPECT_NEAR(m.sd_subject * m.sd_subject, (between - within) / 3, 1e-4);
}

TEST(MixedModel, OfJawsIsThePublishedOne) {
  const Trials t = jaws(false);
  const MixedModel m = fitMixedModel(t.y, t.x, {"mean", "age", "girl"}, t.subject);
  EXPECT_NEAR(m.effects[0].estimate, 17.706713, 5e-6);
  EXPECT_NEAR(m.effects[0].error, 0.8339225, 5e-6);
  EXPECT_NEAR(m.effects[1].estimate, 0.660185, 5e-7);
  EXPECT_NEAR(m.effects[1].error, 0.0616059, 5e-7);
  EXPECT_NEAR(m.effects[2].estimate, -2.321023, 5e-6);
  EXPECT_NEAR(m.effects[2].error, 0.7614168, 5e-6);
  EXPECT_NEAR(m.effects[2].p, 0.0054, 5e-5);
  EXPECT_EQ(m.effects[1].degrees, 80);
  EXPECT_EQ(m.effects[2].degrees, 25);
  EXPECT_TRUE(m.effects[1].within);
  EXPECT_FALSE(m.effects[2].within);
  EXPECT_NEAR(m.sd_subject, 1.807425, 5e-6);
  EXPECT_NEAR(m.sd_residual, 1.431592, 5e-6);
  EXPECT_NEAR(m.log_likelihood, -218.7563, 5e-5);
}

TEST(MixedModel, OfJawsWithTheInteractionIsThePublishedOne) {
  const Trials t = jaws(true);
  const MixedModel m = fitMixedModel(t.y, t.x, {"mean", "age", "girl", "age x girl"}, t.subject);
  EXPECT_NEAR(m.effects[1].estimate, 0.784375, 5e-7);
  EXPECT_NEAR(m.effects[1].error, 0.0775011, 5e-7);
  EXPECT_NEAR(m.effects[3].estimate, -0.304830, 5e-7);
  EXPECT_NEAR(m.effects[3].error, 0.1214209, 5e-7);
  EXPECT_EQ(m.effects[3].degrees, 79);
  EXPECT_NEAR(m.sd_subject, 1.816214, 5e-6);
  EXPECT_NEAR(m.sd_residual, 1.386382, 5e-6);
}

/// A question that differs between subjects only, with equally many trials each, is the pooled
/// t-test of the subjects' means.
TEST(MixedModel, BetweenSubjectsIsTheTestOfTheirMeans) {
  RandomStream random = RandomStream::ofSeed(3);
  Trials t{Eigen::VectorXd(60), Eigen::MatrixXd::Ones(60, 2), {}};
  std::vector<double> a, b;
  for (int s = 0; s < 12; ++s) {
    const double own = 3 * random.openNormal();
    double sum = 0;
    for (int k = 0; k < 5; ++k) {
      const int i = 5 * s + k;
      sum += t.y[i] = 1000 + own + (s < 6 ? 0 : 2) + random.openNormal();
      t.x(i, 1) = s >= 6;
      t.subject.push_back(7 * s);
    }
    (s < 6 ? a : b).push_back(sum / 5);
  }
  const MixedModel m = fitMixedModel(t.y, t.x, {"mean", "group"}, t.subject);
  const TTest means = pooled(b, a);
  EXPECT_NEAR(m.effects[1].t, means.t, 1e-6);
  EXPECT_NEAR(m.effects[1].p, means.p_two_sided, 1e-6);
  EXPECT_NEAR(m.effects[1].low, means.low, 1e-5);
}

TEST(MixedModel, SubjectsWhoAreAlikeHaveNoSpreadOfTheirOwn) {
  Trials t = rails();
  for (int i = 0; i < 18; ++i) t.y[i] = i % 3;  // every subject the same mean
  const MixedModel m = fitMixedModel(t.y, t.x, {"mean"}, t.subject);
  EXPECT_EQ(m.sd_subject, 0);
  EXPECT_EQ(m.alike, 0);
}

TEST(MixedModel, RefusesWhatCannotBeFitted) {
  Trials t = rails();
  const auto refused = [&](const Trials& bad) {
    EXPECT_THROW(
        fitMixedModel(bad.y, bad.x,
                      std::vector<std::string>(static_cast<std::size_t>(bad.x.cols()), "c"),
                      bad.subject),
        Error);
  };
  Trials bad = t;
  bad.subject.pop_back();
  refused(bad);
  bad = t;
  bad.y[3] = NAN;
  refused(bad);
  bad = t;
  bad.x = Eigen::MatrixXd::Ones(18, 2);
  refused(bad);
  bad = t;
  bad.y.setConstant(4);
  refused(bad);
  bad = t;
  bad.subject.assign(18, 1);
  refused(bad);
}

}  // namespace
}  // namespace palpa::statistics
