#include "apps/report/needle/trial_chart.h"

#include <gtest/gtest.h>

#include "synthetic_report.h"

namespace palpa::report {
namespace {

using assess::Moment;

TEST(Timeline, PhasesShareALaneAndErrorsComeLast) {
  const auto lanes = lanesOf(test::trialWithTrouble().spans);
  ASSERT_EQ(lanes.size(), 4u);
  EXPECT_EQ(lanes[0].label, "phases");
  EXPECT_EQ(lanes[0].spans.size(), 3u);
  EXPECT_EQ(lanes[1].label, "clavicle contact");
  EXPECT_EQ(lanes[1].spans.size(), 2u);
  EXPECT_EQ(lanes[2].label, "in the vein");
  EXPECT_EQ(lanes[3].label, "lung");
}

/// No two marks with their words touch in a row; each mark stands at its moment; no line of a later
/// mark runs through words that go rightward.
void expectLegible(const std::vector<Moment>& moments, const std::vector<PlacedMark>& marks,
                   const Axis& x) {
  ASSERT_EQ(marks.size(), moments.size());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    EXPECT_NEAR(marks[i].x, x.at(moments[i].t_s), 1e-9);
    for (std::size_t k = i + 1; k < marks.size(); ++k) {
      const PlacedMark &a = marks[i], &b = marks[k];
      if (a.row == b.row) {
        EXPECT_TRUE(a.to_px < b.from_px || b.to_px < a.from_px) << i << " and " << k;
      }
      const bool through = b.row > a.row && b.x > a.from_px && b.x < a.to_px;
      EXPECT_FALSE(through) << "line of " << k << " through " << i;
    }
  }
}

TEST(Timeline, MarksDoNotOverlap) {
  const Axis x = kWide.across(0, 31.5);
  const auto moments = test::trialWithTrouble().moments;
  const auto marks = placeMarks(moments, x, kWide, 7);
  EXPECT_TRUE(marks.front().words);
  expectLegible(moments, marks, x);
  for (const auto& mark : marks) EXPECT_LE(mark.to_px, kWide.width);
  expectLegible(moments, placeMarks(moments, kNarrow.across(0, 31.5), kNarrow, 7),
                kNarrow.across(0, 31.5));
}

TEST(Timeline, CrowdedMomentsBecomeNumbers) {
  const Axis x = kWide.across(0, 30);
  std::vector<Moment> moments;
  for (int i = 0; i < 40; ++i)
    moments.push_back({15 + 0.01 * i, "bone", "The clavicle was touched"});
  const auto marks = placeMarks(moments, x, kWide, 7);
  for (const auto& mark : marks) EXPECT_FALSE(mark.words);
  expectLegible(moments, marks, x);
}

TEST(Timeline, CutsTextAtWholeLetters) {
  EXPECT_EQ(fitted("lung", 100, 13), "lung");
  const std::string cut = fitted("ÄÖÜÄÖÜÄÖÜÄÖÜ", 60, 13);
  EXPECT_LE(textWidth(cut, 13), 60);
  EXPECT_EQ(escaped(cut), cut);  // still valid UTF-8
  EXPECT_TRUE(cut.ends_with("…"));
}

}  // namespace
}  // namespace palpa::report
