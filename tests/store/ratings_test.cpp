#include "apps/record/store/study_store.h"

#include "tests/store/stores.h"

namespace palpa::record {
namespace {

class Ratings : public Store {};

std::vector<Rating> sheet(const std::string& rater, std::int64_t value, std::int64_t trial = 1) {
  return {{"u1", trial, rater, "subclavian", "sha", "held", value, "2026-03-01T11:00:00Z"},
          {"u1", trial, rater, "subclavian", "sha", "sterile", value, "2026-03-01T11:00:00Z"}};
}

TEST_P(Ratings, AreKeptReplacedAndGoWithThePerson) {
  RecordStore store(url);
  store.addTrainee(novice("T1"));
  store.addTrial(sessionOf("T1", "u1"), trialOf(1));
  enterRatings(store, sheet("R1", 1));
  enterRatings(store, sheet("R2", -1));
  ASSERT_EQ(ratingsIn(store).size(), 4u);
  enterRatings(store, {sheet("R1", 0).front()});  // the sheet entered again, with one item
  const std::vector<Rating> all = ratingsIn(store, "u1");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].rater, "R1");
  EXPECT_EQ(all[0].item, "held");
  EXPECT_EQ(all[0].value, 0);
  EXPECT_EQ(all[1].value, -1);
  EXPECT_EQ(all[1].form_sha256, "sha");
  EXPECT_TRUE(ratingsIn(store, "u2").empty());
  store.deletePerson("T1", "2026-03-02T11:00:00Z");
  EXPECT_TRUE(ratingsIn(store).empty());
}

TEST_P(Ratings, OfATrialThatIsNotThereOrOfSeveralSheetsAreRefused) {
  RecordStore store(url);
  store.addTrainee(novice("T1"));
  store.addTrial(sessionOf("T1", "u1"), trialOf(1));
  EXPECT_THROW(enterRatings(store, sheet("R1", 1, 2)), UsageError);
  EXPECT_THROW(enterRatings(store, sheet("Dr Smith", 1)), UsageError);
  std::vector<Rating> mixed = sheet("R1", 1);
  mixed[1].rater = "R2";
  EXPECT_THROW(enterRatings(store, mixed), UsageError);
  EXPECT_TRUE(ratingsIn(store).empty());
}

INSTANTIATE_TEST_SUITE_P(Both, Ratings, testing::Values("SQLite", "PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

}  // namespace
}  // namespace palpa::record
