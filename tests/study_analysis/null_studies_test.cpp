#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "apps/study/analysis/power_analysis.h"
#include "tests/support/counts.h"

namespace palpa::study_analysis {
namespace {

bool inBand(int count, const Band& band) { return count >= band.low && count <= band.high; }

/// Two thousand light studies of 20 subjects and 10 trials without any effect. In time and in score
/// they are the same draws on another scale, so one of them will do. Welch's test on five and five
/// is a little timid itself (about 4.5 % where 5 % are nominal); the paired test is exact.
TEST(NullStudies, OneValueASubjectKeepsTheNominalRateAndPooledTrialsDoNot) {
  const Detections found = detectionsIn(nullModels()[1], {});
  const Band band = binomialBand(2000, 0.05);
  EXPECT_EQ(found.studies, 2000);
  EXPECT_PRED2(inBand, found.groups, band);
  EXPECT_PRED2(inBand, found.learning, band);
  EXPECT_GT(found.groups_published, 3 * band.high) << "too many degrees of freedom between groups";
  EXPECT_LT(found.learning_published, band.low) << "too timid within subjects";
}

/// It is the likeness of one subject's trials that makes pooling wrong: without it pooled tests are
/// fair, with more of it they are worse.
TEST(NullStudies, PoolingIsWrongByTheLikenessOfTrials) {
  Detections before;
  for (const double own : {0.0, 0.5, 0.8}) {
    LearningModel model = nullModels()[0];
    const double variance =
        model.subject_sd * model.subject_sd + model.residual_sd * model.residual_sd;
    model.subject_sd = std::sqrt(own * variance);
    model.residual_sd = std::sqrt((1 - own) * variance);
    DrawnStudies drawn;
    drawn.studies = palpa::test::counted(600, 2000);
    const Detections found = detectionsIn(model, drawn);
    const Band band = binomialBand(drawn.studies, 0.05);
    if (own == 0) {
      EXPECT_PRED2(inBand, found.groups_published, band);
      EXPECT_PRED2(inBand, found.learning_published, band);
    } else {
      EXPECT_GT(found.groups_published, before.groups_published);
      EXPECT_LT(found.learning_published, before.learning_published);
    }
    before = found;
  }
}

TEST(NullStudies, PlantedEffectsAreFound) {
  const DrawnStudies drawn{500};
  for (const LearningModel& model : pilotModels()) {
    const Detections found = detectionsIn(model, drawn);
    const Band band = binomialBand(500, 0.05);
    EXPECT_GT(found.groups, 3 * band.high) << model.metric;
    EXPECT_GT(found.learning, 300) << model.metric;
  }
}

TEST(NullStudies, BandsAreTheBinomialOnes) {
  const Band band = binomialBand(2000, 0.05);  // mean 100, standard deviation 9.75
  EXPECT_NEAR(band.low, 100 - 1.96 * 9.75, 1.5);
  EXPECT_NEAR(band.high, 100 + 1.96 * 9.75, 1.5);
}

/// Drawn scores follow the model: means over many subjects on the curve, spread between and within
/// subjects as given.
TEST(LearningModel, DrawsWhatItSays) {
  const std::vector<LearningModel> models = pilotModels();
  const std::vector<StudyRow> rows = drawStudy(models, 2000, 10, 3);
  EXPECT_EQ(rows.size(), 4u * 2000 * 10);
  double first_two = 0, last_two = 0, within = 0;
  for (std::size_t i = 0; i < 2000 * 10; i += 10) {  // novices without force feedback
    EXPECT_EQ(rows[i].trial, 1);
    first_two += (rows[i].metric("time_s") + rows[i + 1].metric("time_s")) / 2 / 2000;
    last_two += (rows[i + 8].metric("time_s") + rows[i + 9].metric("time_s")) / 2 / 2000;
    within += std::pow(rows[i + 9].metric("time_s") - rows[i + 8].metric("time_s"), 2) / 2 / 2000;
  }
  EXPECT_NEAR(first_two, 71.5, 2) << "standard error 0.5 s";  // printed in table 3
  EXPECT_NEAR(last_two, 55.2, 2);
  EXPECT_NEAR(std::sqrt(within), models[0].residual_sd, 1.5);
  for (const StudyRow& row : rows) ASSERT_TRUE(row.simulated);
}

TEST(LearningModel, TheSameSeedDrawsTheSameAndAnotherOneNot) {
  const auto draw = [](std::uint64_t seed) {
    return drawStudy(pilotModels(), 2, 4, seed)[5].metric("total");
  };
  EXPECT_EQ(draw(1), draw(1));
  EXPECT_NE(draw(1), draw(2));
}

TEST(LearningModel, RefusesStudiesOfNobody) {
  EXPECT_THROW(drawStudy({}, 5, 10, 1), UsageError);
  EXPECT_THROW(drawStudy(pilotModels(), 0, 10, 1), UsageError);
  EXPECT_THROW(detectionsIn(pilotModels()[0], {10, 5, 3}), UsageError);
  LearningModel one = pilotModels()[0];
  one.curves.resize(1);
  EXPECT_THROW(detectionsIn(one, {}), UsageError);
}

}  // namespace
}  // namespace palpa::study_analysis
