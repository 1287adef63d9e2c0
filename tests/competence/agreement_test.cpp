#include "apps/assess/competence/rating_agreement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpa::competence::test {
namespace {

/// A trial whose raters graded one aspect so, and whose total was that.
RatedTrial graded(const std::map<std::string, int>& grades, double total) {
  RatedTrial t;
  for (const auto& [rater, grade] : grades) t.global[rater] = {{"plan", grade}};
  t.total = total;
  return t;
}

// Shrout and Fleiss 1979, table 2: six subjects, four judges. The global rating's means are the
// table's scores here, whatever their scale.
TEST(RatingAgreement, IsTheIccOfShroutAndFleiss) {
  const int table[6][4] = {{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                           {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};
  std::vector<RatedTrial> trials;
  for (int i = 0; i < 6; ++i)
    trials.push_back(
        graded({{"A", table[i][0]}, {"B", table[i][1]}, {"C", table[i][2]}, {"D", table[i][3]}},
               100.0 * i));
  trials.push_back(graded({{"A", 3}}, 1));  // seen by one rater only: not in the ICC
  const Agreement a = agreementOf(trials);
  ASSERT_TRUE(a.global);
  EXPECT_EQ(a.trials, 6);
  EXPECT_NEAR(a.global->agreement.value, 0.29, 0.005);
  EXPECT_NEAR(a.global->consistency.value, 0.71, 0.005);
}

TEST(RatingAgreement, KappaOfTwoRatersAndOfTheSimulator) {
  // Two raters over four trials of one item: 20 alike of 25 would be the published table; here by
  // hand: both done 2, both not 1, one apart.
  ChecklistItem automatic{"a", "automatic", true, {{"success", 1}}, false};
  std::vector<RatedTrial> trials(4);
  const int one[] = {kDone, kDone, kNotDone, kDone}, other[] = {kDone, kDone, kNotDone, kNotDone};
  const Mark simulator[] = {Mark::done, Mark::not_done, Mark::not_done, Mark::open};
  for (std::size_t i = 0; i < 4; ++i) {
    trials[i].checklist = {{"R1", {{"a", one[i]}}}, {"R2", {{"a", other[i]}}}};
    trials[i].simulator = {{&automatic, simulator[i], ""}};
  }
  const Agreement a = agreementOf(trials);
  ASSERT_EQ(a.checklist.size(), 3u);
  EXPECT_EQ(a.checklist[0].items, 4);
  EXPECT_NEAR(a.checklist[0].alike, 0.75, 1e-12);
  EXPECT_NEAR(a.checklist[0].kappa, (0.75 - 0.5) / (1 - 0.5),
              1e-12);  // by chance: .75 x .5 + .25 x .5
  EXPECT_EQ(a.checklist[1].other, "simulator");
  EXPECT_EQ(a.checklist[1].items, 3);  // what the simulator left open is not compared
  EXPECT_NEAR(a.checklist[1].alike, 2.0 / 3, 1e-12);
}

TEST(RatingAgreement, WellRatedTrialsWithLittlePenaltyCorrelate) {
  const Agreement opposed = agreementOf({graded({{"A", 5}}, 100), graded({{"A", 4}}, 300),
                                         graded({{"A", 2}}, 2000), graded({{"A", 1}}, 2500)});
  ASSERT_TRUE(opposed.with_total);
  EXPECT_NEAR(*opposed.with_total, -1, 1e-12);
  EXPECT_EQ(opposed.scored, 4);
  EXPECT_FALSE(opposed.global);  // one rater
}

TEST(RatingAgreement, SaysWhatIsMissing) {
  const Agreement none = agreementOf({});
  EXPECT_EQ(none.missing.size(), 3u);
  EXPECT_FALSE(none.global || none.with_total);
  const Agreement alike =
      agreementOf({graded({{"A", 3}, {"B", 3}}, 1), graded({{"A", 3}, {"B", 3}}, 1)});
  EXPECT_FALSE(alike.global);  // the trials do not differ: no ICC
  EXPECT_FALSE(alike.with_total);
}

}  // namespace
}  // namespace palpa::competence::test
