#include "apps/training/trial_words.h"

#include <gtest/gtest.h>

namespace palpa::training {
namespace {

TEST(TrialWords, RolesRoundTrip) {
  for (const Role role : {Role::none, Role::scored, Role::assessed, Role::familiarisation,
                          Role::demonstration, Role::guided, Role::not_scored})
    EXPECT_EQ(roleNamed(nameOf(role)), role) << nameOf(role);
  EXPECT_EQ(nameOf(Role::none), "");
  EXPECT_EQ(nameOf(Role::not_scored), "not scored");
}

TEST(TrialWords, OutcomesRoundTrip) {
  for (const Outcome outcome :
       {Outcome::none, Outcome::success, Outcome::done, Outcome::time, Outcome::passes,
        Outcome::aborted, Outcome::voided, Outcome::not_scored})
    EXPECT_EQ(outcomeNamed(nameOf(outcome)), outcome) << nameOf(outcome);
  EXPECT_EQ(nameOf(Outcome::none), "");
  EXPECT_EQ(nameOf(Outcome::voided), "void");
}

TEST(TrialWords, OfNoTableCountForNothing) {
  EXPECT_FALSE(countsAsScored(roleNamed("exam")));
  EXPECT_NE(roleNamed("exam"), Role::none);
  EXPECT_EQ(outcomeNamed("lost"), Outcome::none);
  EXPECT_FALSE(isVoid("lost"));
  EXPECT_TRUE(isVoid("void"));
}

TEST(TrialWords, ScoredAndAssessedCount) {
  EXPECT_TRUE(countsAsScored(Role::scored));
  EXPECT_TRUE(countsAsScored(Role::assessed));
  for (const Role role :
       {Role::none, Role::familiarisation, Role::demonstration, Role::guided, Role::not_scored})
    EXPECT_FALSE(countsAsScored(role)) << nameOf(role);
  EXPECT_TRUE(inAssessment(Role::assessed));
  EXPECT_FALSE(inAssessment(Role::scored));
}

}  // namespace
}  // namespace palpa::training
