#include "apps/bench/estimator_studies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/counts.h"

/// The estimators beside the bound that the data set them (500 sets each in the full run: then the
/// bars themselves; of fewer sets three standard errors more).
namespace palpa::bench {
namespace {

class Estimator : public testing::TestWithParam<EstimatorStudy> {};

TEST_P(Estimator, ComesNearTheCramerRaoBoundAndKnowsItsError) {
  const int sets = test::counted(40, 500);
  const double slack = test::fullCounts() ? 0 : 3;
  const StudyFigures figures = figuresOf(GetParam(), sets, 0);
  EXPECT_EQ(figures.refused, 0);
  EXPECT_LE(figures.ratio, 1.15 + slack / std::sqrt(2.0 * sets));
  const double of_share = slack * std::sqrt(0.95 * 0.05 / sets);
  EXPECT_GE(figures.coverage, 0.92 - of_share);
  EXPECT_LE(figures.coverage, 0.98 + of_share);
}

TEST_P(Estimator, IsNotMisledByATenthOfGrossErrors) {
  const int sets = test::counted(40, 500);
  const StudyFigures figures = figuresOf(GetParam(), sets, 0.1);
  EXPECT_EQ(figures.refused, 0);
  EXPECT_LE(figures.ratio, 1.5 + (test::fullCounts() ? 0 : 3 / std::sqrt(2.0 * sets)));
}

INSTANTIATE_TEST_SUITE_P(Every, Estimator, testing::ValuesIn(estimatorStudies()),
                         [](const auto& study) {
                           std::string name;
                           for (const char c : study.param.name)
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

// The bound itself, where it is known: the mean of n numbers has sd / sqrt(n).
TEST(CramerRaoBound, OfAMeanIsTheOneOfTheBook) {
  const MatrixX bound = cramerRaoBound(
      {25, 1, [](int, const VectorX& dx, const VectorX& e) -> VectorX { return dx - e; },
       VectorX::Constant(1, 0.5)});
  EXPECT_NEAR(std::sqrt(bound(0, 0)), 0.1, 1e-9);
}

}  // namespace
}  // namespace palpa::bench
