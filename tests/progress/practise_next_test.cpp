#include <gtest/gtest.h>

#include "apps/assess/progress/errors.h"

/// What a session's report advises.
namespace palpa::progress {
namespace {

using training::Engine;
using training::Outcome;
using training::Role;

JudgedTrial needle(double landmarks, double success, Role role = Role::scored) {
  return {role, Outcome::success, {{"error_landmarks", landmarks}, {"success", success}}};
}

bool isAgainstLandmarks(const std::vector<std::string>& next) {
  return next.size() == 1 && next[0].find("suprasternal notch") != std::string::npos;
}

TEST(PractiseNext, IsAgainstWhatWentWrongOftenOrLast) {
  EXPECT_TRUE(isAgainstLandmarks(practiseNext(Engine::needle, {needle(1, 1)})));
  EXPECT_TRUE(
      isAgainstLandmarks(practiseNext(Engine::needle, {needle(1, 1), needle(1, 1), needle(0, 1)})));
  const auto mended = practiseNext(Engine::needle, {needle(1, 1), needle(0, 1)});
  ASSERT_EQ(mended.size(), 1u);
  EXPECT_EQ(mended[0], "the same on other patients and on the other side");
}

TEST(PractiseNext, SaysNothingOfTrialsThatDoNotCount) {
  EXPECT_TRUE(practiseNext(Engine::needle, {}).empty());
  EXPECT_TRUE(practiseNext(Engine::needle, {needle(1, 0, Role::familiarisation)}).empty());
}

}  // namespace
}  // namespace palpa::progress
