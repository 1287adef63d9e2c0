#include <gtest/gtest.h>

#include "apps/trial/trial_status.h"

namespace palpa::trial {
namespace {

using training::Outcome;
using training::Role;

/// Whoever is examined learns nothing from one trial for the next.
TEST(EndNotice, AnAssessmentTellsNoResult) {
  const std::string result = "2 of 3 lumps found";
  EXPECT_EQ(endNotice(Role::scored, Outcome::done, result), result);
  EXPECT_EQ(endNotice(Role::scored, Outcome::success, result), result);
  EXPECT_EQ(endNotice(Role::scored, Outcome::time, result), "Trial ended: time");
  EXPECT_EQ(endNotice(Role::scored, Outcome::mistaken, result, "It was not said what was drawn"),
            "Trial ended. It was not said what was drawn");
  EXPECT_EQ(endNotice(Role::guided, Outcome::aborted, result), "Trial ended: aborted");
  const std::string silent = endNotice(Role::assessed, Outcome::done, result);
  for (const Outcome outcome :
       {Outcome::success, Outcome::done, Outcome::time, Outcome::passes, Outcome::mistaken})
    EXPECT_EQ(endNotice(Role::assessed, outcome, result), silent) << training::nameOf(outcome);
  EXPECT_EQ(silent.find("found"), std::string::npos);
  EXPECT_EQ(endNotice(Role::assessed, Outcome::voided, result), "Trial ended: void");
  EXPECT_EQ(endNotice(Role::assessed, Outcome::aborted, result), "Trial ended: aborted");
}

}  // namespace
}  // namespace palpa::trial
