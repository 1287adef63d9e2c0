#include "apps/study/progress.h"

#include "small_protocol.h"

namespace palpa::study {
namespace {

constexpr const char* kMonday = "2026-03-02T10:00:00Z";

class Progress : public testing::Test {
 protected:
  /// `count` trials of a step in one session, a minute each.
  void add(std::int64_t step, int count, const std::string& began = kMonday,
           const std::string& outcome = "success") {
    for (int i = 1; i <= count; ++i)
      trials.push_back({step, "u" + std::to_string(trials.size()), began, 60.0 * i, outcome});
  }
  Next next(const std::string& now = "2026-03-02T12:00:00Z") const {
    return nextOf(protocol, "B", trials, answered, now);
  }

  const Protocol protocol = readProtocol(written(smallProtocol()));
  std::vector<DoneTrial> trials;
  std::vector<std::pair<int, std::string>> answered;
};

TEST_F(Progress, LeadsThroughEverythingInOrder) {
  EXPECT_EQ(next().step, 1);
  EXPECT_EQ(next().condition, "plain");
  add(1, 1);
  EXPECT_EQ(next().step, 2);
  EXPECT_EQ(next().condition, "B");  // that was drawn
  EXPECT_EQ(next().trials, 2);       // then a rest
  add(2, 2);
  EXPECT_EQ(next().done, 2);
  EXPECT_EQ(next().left, 3);
  EXPECT_EQ(next().trials, 2);
  add(2, 2);
  EXPECT_EQ(next().trials, 1);
  add(2, 1);
  EXPECT_EQ(next().session, 2);
  EXPECT_EQ(next().not_before, "2026-03-04");
  EXPECT_EQ(next("2026-03-04T00:00:00Z").not_before, "");
  add(3, 2, "2026-03-04T09:00:00Z");
  ASSERT_EQ(next().kind, NextKind::questionnaire);
  EXPECT_EQ(next().open_items, (std::vector<std::string>{"useful", "remarks"}));
  answered.emplace_back(2, "useful");
  EXPECT_EQ(next().open_items, std::vector<std::string>{"remarks"});
  answered.emplace_back(2, "remarks");
  EXPECT_EQ(next().kind, NextKind::finished);
}

TEST_F(Progress, VoidTrialsDoNotCountAndABrokenSetGoesOnWhereItStopped) {
  add(1, 1);
  add(2, 1);
  add(2, 1, kMonday, "void");
  EXPECT_EQ(next().done, 1);
  EXPECT_EQ(next().trials, 1);  // of the set of two
  add(2, 1, kMonday, "aborted");
  EXPECT_EQ(next().done, 2);  // a trial that failed is one
}

TEST_F(Progress, RestsAreDueAfterSetsAndBlocksAndNotWithin) {
  add(1, 1);  // ended at 10:01, 60 s of rest
  EXPECT_EQ(next("2026-03-02T10:01:20Z").rest_s, 40);
  EXPECT_EQ(next("2026-03-02T10:05:00Z").rest_s, 0);
  add(2, 1);
  EXPECT_EQ(next("2026-03-02T10:01:00Z").rest_s, 0);  // within a set
  add(2, 1, "2026-03-02T10:10:00Z");
  EXPECT_EQ(next("2026-03-02T10:11:30Z").rest_s, 70);
}

TEST_F(Progress, ClocksThatJumpAreToldAndCostNothing) {
  add(1, 1);
  EXPECT_TRUE(next().remarks.empty());
  const Next back = next("2026-03-01T10:00:00Z");
  EXPECT_EQ(back.rest_s, 60);  // no longer than it is
  ASSERT_EQ(back.remarks.size(), 1u);
  EXPECT_NE(back.remarks[0].find("check the clock"), std::string::npos);
  add(2, 2, "2020-01-01T00:00:00Z");  // arrived later, dated earlier
  EXPECT_EQ(next().done, 2);
  ASSERT_EQ(next().remarks.size(), 1u);
  EXPECT_NE(next().remarks[0].find("2020-01-01T00:00:00Z, before the one"), std::string::npos)
      << next().remarks[0];
  EXPECT_EQ(next().rest_s, 0);
}

TEST_F(Progress, DaysAreCountedFromWhatArrivedLast) {
  add(1, 1);
  add(2, 5, "2026-03-31T23:59:00Z");
  EXPECT_EQ(next("2026-04-01T00:00:00Z").not_before, "2026-04-02");
  add(3, 1, "2026-04-02T08:00:00Z");
  EXPECT_EQ(next("2026-04-02T08:30:00Z").not_before, "");  // it has begun
}

}  // namespace
}  // namespace palpa::study
