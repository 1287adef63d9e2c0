#include "apps/record/store/learner_store.h"

#include "tests/store/stores.h"

namespace palpa::record {
namespace {

constexpr char kNow[] = "2026-03-01T12:30:00Z";

TEST_P(Store, GivesOneWhomAPlatformKnowsOnePseudonym) {
  RecordStore store(url);
  LearnerStore learners(store);
  EXPECT_EQ(learners.knownTrainee("campus", "17"), "");
  const std::string first = learners.traineeFor("campus", "17", kNow);
  EXPECT_TRUE(first.starts_with("learner-")) << first;
  EXPECT_EQ(learners.traineeFor("campus", "17", kNow), first);
  EXPECT_EQ(learners.knownTrainee("campus", "17"), first);
  EXPECT_NE(learners.traineeFor("campus", "18", kNow), first);
  EXPECT_NE(learners.traineeFor("uni", "17", kNow), first) << "another platform's 17";
  EXPECT_NE(learners.traineeFor("campus1", "7", kNow), first) << "names do not run together";
  const auto trainee = store.trainee(first);
  ASSERT_TRUE(trainee);
  EXPECT_TRUE(trainee->consent_utc.empty()) << "an educator notes it once it was given";
  RecordStore again(url);
  EXPECT_EQ(LearnerStore(again).knownTrainee("campus", "17"), first) << "by another console, too";
}

TEST_P(Store, ForgetsWhoWasDeletedOfAPlatform) {
  RecordStore store(url);
  LearnerStore learners(store);
  const std::string first = learners.traineeFor("campus", "17", kNow);
  store.deletePerson(first, kNow);
  EXPECT_EQ(learners.knownTrainee("campus", "17"), "");
  EXPECT_NE(learners.traineeFor("campus", "17", kNow), first);
}

}  // namespace
}  // namespace palpa::record
