#include "apps/task_needle/task_file.h"

#include <gtest/gtest.h>

#include "haptics/flight_record.h"

namespace palpa::task_needle {
namespace {

constexpr std::uint32_t kFirst = 1, kSeat = 2;

TaskWords boneWords() {
  TaskWords words;
  words.organ[static_cast<std::size_t>(Organ::skin)] = "bone";
  words.organ[static_cast<std::size_t>(Organ::fascia)] = "far cortex";
  return words;
}

/// A trial whose parts are given second by second, a sample each tenth of a second.
GoalTrial trialOf(const std::vector<std::uint32_t>& parts, double for_s = 1) {
  GoalTrial trial({1, for_s, "it sits"}, {"first", "seat"}, boneWords());
  for (std::size_t i = 0; i <= 10 * parts.size(); ++i) {
    assess::TrialSample sample;
    sample.t_s = 0.1 * static_cast<double>(i);
    sample.subtasks = parts[std::min(i / 10, parts.size() - 1)];
    sample.depth = 0.004;
    trial.add(sample);
  }
  return trial;
}

TEST(GoalTrial, IsReachedAfterItsPartWasOnForSoLongAtAStretch) {
  EXPECT_FALSE(trialOf({kFirst, kFirst}).reached());
  EXPECT_TRUE(trialOf({kFirst, kSeat, kSeat}).reached());
  EXPECT_FALSE(trialOf({kSeat, kSeat, kSeat, kFirst})
                   .reached());  // it was, and no longer is: who judges asks each tick
  EXPECT_FALSE(trialOf({kSeat, 0, kSeat, 0, kSeat}, 1.5).reached());  // at a stretch
  EXPECT_TRUE(trialOf({0, kSeat}, 0).reached());
  EXPECT_FALSE(trialOf({0, kFirst}, 0).reached());
  EXPECT_FALSE(GoalTrial({0, 0, ""}, {"one"}, {}).reached());  // nothing has happened yet
}

TEST(GoalTrial, SaysWhatIsOn) {
  EXPECT_EQ(trialOf({0}).step(), "");
  EXPECT_EQ(trialOf({kFirst}).step(), "first");
  EXPECT_EQ(trialOf({kFirst | kSeat}).step(), "seat");
}

TEST(GoalTrial, TellsItsCourse) {
  GoalTrial trial = trialOf({0, kFirst, kFirst | kSeat});
  assess::TrialSample sample;
  sample.t_s = 3.5;
  sample.subtasks = kSeat;
  sample.depth = 0.0124;
  sample.events = haptics::kSkinPunctured | haptics::kWallPunctured;
  sample.wall = Organ::fascia;
  trial.add(sample);
  assess::TrialAssessment a;
  trial.describe(&a);
  EXPECT_FALSE(a.by_path);
  EXPECT_TRUE(a.values.success);
  EXPECT_EQ(a.values.time_ms, 3500);
  EXPECT_EQ(a.skin_punctures, 1);
  ASSERT_EQ(a.spans.size(), 2u);
  EXPECT_EQ(a.spans[0].label, "first");
  EXPECT_EQ(a.spans[0].from_s, 1);
  EXPECT_EQ(a.spans[0].to_s, 3.5);
  EXPECT_EQ(a.spans[1].label, "seat");
  EXPECT_EQ(a.spans[1].kind, assess::SpanKind::good);
  EXPECT_EQ(a.spans[1].from_s, 2);
  ASSERT_EQ(a.moments.size(), 3u);
  EXPECT_EQ(a.moments[0].text, "Through the surface of the bone");
  EXPECT_EQ(a.moments[1].text, "Through the far cortex");
  EXPECT_EQ(a.moments[2].text, "Done: it sits");
  EXPECT_EQ(a.summary, "Done after 4 s: it sits. It went 12 mm deep at most.");
  assess::TrialAssessment none;
  trialOf({kFirst, kFirst}).describe(&none);
  EXPECT_EQ(none.summary, "Not done after 2 s; the goal: it sits. It went 4 mm deep at most.");
}

}  // namespace
}  // namespace palpa::task_needle
