#include <gtest/gtest.h>

#include "anatomy/geometry/error.h"
#include "apps/study_analysis/null_studies.h"

namespace palpa::study_analysis {
namespace {

/// Two thousand light studies of 20 subjects and 10 trials without any effect.
TEST(NullStudies, OneValueASubjectKeepsTheNominalRateAndPooledTrialsDoNot) {
  for (const LearningModel& model : nullModels()) {
    SCOPED_TRACE(model.metric);
    const Detections found = detectionsIn(model, {});
    const Band band = binomialBand(2000, 0.05);
    printf("%s: groups %d learning %d published: groups %d learning %d band %d..%d\n", model.metric.c_str(), found.groups, found.learning, found.groups_published, found.learning_published, band.low, band.high);
    EXPECT_EQ(found.studies, 2000);
    EXPECT_GE(found.groups, band.low);
    EXPECT_LE(found.groups, band.high);
    EXPECT_GE(found.learning, band.low);
    EXPECT_LE(found.learning, band.high);
    EXPECT_GT(found.groups_published, band.high);
    EXPECT_LT(found.learning_published, band.low);
  }
}

TEST(NullStudies, PlantedEffectsAreFoundInTheirDirection) {
  for (const LearningModel& model : pilotModels()) {
    SCOPED_TRACE(model.metric);
    const Detections found = detectionsIn(model, {500});
    printf("%s: %d %d %d %d\n", model.metric.c_str(), found.groups, found.learning, found.groups_published, found.learning_published);
    EXPECT_GT(found.groups, 250);
    EXPECT_GT(found.learning, 250);
  }
}

}  // namespace
}  // namespace palpa::study_analysis
