#include "apps/assess/competence/verdict.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/competence/reference.h"
#include "tests/support/counts.h"

namespace palpa::competence::test {
namespace {

using palpa::test::Script;

/// A list of `items` items that a rater judges, the first `major` of them major.
Checklist listOf(int items, int major) {
  Checklist list;
  list.standards = {0.98, 0.90};
  list.competent = {17, 5};
  list.borderline = {10, 2};
  for (int i = 0; i < items; ++i)
    list.items.push_back({"i" + std::to_string(i), "item", i < major, {}, false});
  return list;
}

Answers all(const Checklist& list, int answer) {
  Answers answers;
  for (const ChecklistItem& item : list.items) answers[item.id] = answer;
  return answers;
}

Answers grades(const GlobalRating& rating, int grade) {
  Answers answers;
  for (const RatingItem& item : rating.items) answers[item.id] = grade;
  return answers;
}

std::optional<double> noFigures(const std::string&) { return std::nullopt; }

const VerdictFacts kAssessed{true, training::Outcome::success};

/// Every rater's item of the shipped list done.
Answers ratersItemsDone(const Checklist& list) {
  Answers answers;
  for (const ChecklistItem& item : list.items)
    if (item.byRater()) answers[item.id] = kDone;
  return answers;
}

Verdict verdictOf(const Script& script, std::uint64_t seed, const Checklist& list,
                  double standard = 0.98) {
  RandomStream draw = RandomStream::ofSeed(seed);
  const assess::TrialAssessment a = judged(script, seed, draw);
  const GlobalRating global = shippedGlobal();
  return judge({true, a.outcome}, list, figuresOf(a), ratersItemsDone(list), &global,
               grades(global, 5), standard);
}

TEST(Verdict, AGoodTrialWithAGoodRatingPasses) {
  const Checklist list = shippedChecklist();
  const Verdict v = verdictOf({}, 2, list);
  for (const MarkedItem& m : v.items)
    EXPECT_TRUE(m.mark == Mark::done || m.mark == Mark::did_not_arise)
        << m.item->id << ": " << m.why;
  for (const std::string& reason : v.reasons) ADD_FAILURE() << reason;
  EXPECT_EQ(v.status, Status::passed);
  EXPECT_EQ(v.level, "competent");
  EXPECT_EQ(v.score.low, 1);
  EXPECT_EQ(v.score.did_not_arise, 1);  // it was never drawn back
}

TEST(Verdict, APleuralOrArterialPunctureFailsWhateverElseWasDone) {
  for (const Tissue tissue : {Tissue::lung, Tissue::artery_lumen}) {
    for (int i = 0; i < palpa::test::counted(5, 100); ++i) {
      Checklist list = shippedChecklist();
      // Every item done, those about pleura and artery among them: by a rater who looked away.
      for (ChecklistItem& item : list.items) item.rules.clear();
      Script script;
      script.meets = tissue;
      const Verdict v = verdictOf(script, 90'000 + static_cast<std::uint64_t>(i), list);
      EXPECT_EQ(v.score.low, 1);
      EXPECT_EQ(v.status, Status::failed);
      ASSERT_EQ(v.critical.size(), 1u);
      EXPECT_EQ(v.critical[0],
                tissue == Tissue::lung ? "the pleura was punctured" : "an artery was punctured");
    }
  }
}

TEST(Verdict, FourPassesFail) {
  Script script;
  script.redirections = 2;
  EXPECT_EQ(verdictOf(script, 2, shippedChecklist()).status, Status::passed);
  script.redirections = 3;
  const Verdict v = verdictOf(script, 2, shippedChecklist());
  EXPECT_EQ(v.status, Status::failed);
  EXPECT_EQ(v.critical, std::vector<std::string>{"the needle was passed more than three times"});
}

TEST(Verdict, WithoutSuctionTheItemIsNotDone) {
  Script script;
  script.suction = false;
  const Checklist list = shippedChecklist();
  const Verdict v = verdictOf(script, 2, list);
  for (const MarkedItem& m : v.items)
    if (m.item->id == "suction") {
      EXPECT_EQ(m.mark, Mark::not_done);
      EXPECT_EQ(m.why, "Advanced under suction: 0 % (at least 50 %)");
    }
  EXPECT_EQ(v.status, Status::failed);
  EXPECT_EQ(verdictOf(script, 2, list, 0.90).status, Status::passed);  // 23 of 24 are 95.8 %
}

TEST(Verdict, NobodyPassesWithoutARaterOrInPractice) {
  const Checklist list = shippedChecklist();
  const GlobalRating global = shippedGlobal();
  RandomStream draw = RandomStream::ofSeed(2);
  const assess::TrialAssessment a = judged({}, 2, draw);
  const auto judgedWith = [&](const VerdictFacts& facts, const Answers& items,
                              const Answers& rating) {
    return judge(facts, list, figuresOf(a), items, &global, rating, 0.98);
  };
  const Verdict alone = judgedWith(kAssessed, {}, {});
  EXPECT_EQ(alone.status, Status::not_certified);
  EXPECT_EQ(alone.score.open, 7);
  ASSERT_EQ(alone.reasons.size(), 2u);
  EXPECT_EQ(alone.reasons[0], "Checklist: 17 of 24 items done; 7 need a rater; 98 % is asked for.");
  EXPECT_EQ(alone.reasons[1], "No global rating was given.");
  EXPECT_EQ(judgedWith(kAssessed, ratersItemsDone(list), {}).status, Status::not_certified);
  EXPECT_EQ(
      judgedWith({false, training::Outcome::success}, ratersItemsDone(list), grades(global, 5))
          .status,
      Status::not_certified);
  EXPECT_EQ(judgedWith({true, training::Outcome::voided}, ratersItemsDone(list), grades(global, 5))
                .status,
            Status::not_certified);
  Answers gap = grades(global, 5);
  gap.erase("feel");
  EXPECT_EQ(judgedWith(kAssessed, ratersItemsDone(list), gap).status, Status::not_certified);
  EXPECT_EQ(judgedWith(kAssessed, ratersItemsDone(list), grades(global, 3)).status, Status::passed);
  EXPECT_EQ(judgedWith(kAssessed, ratersItemsDone(list), grades(global, 2)).status, Status::failed);
  Answers one_bad = grades(global, 5);
  one_bad["care"] = 1;
  EXPECT_EQ(judgedWith(kAssessed, ratersItemsDone(list), one_bad).status, Status::failed);
}

TEST(Verdict, WhatIsNotJudgedMakesTheShareUncertain) {
  const Checklist list = listOf(24, 19);
  Answers answers = all(list, kDone);
  answers["i0"] = kNotDone;
  answers["i1"] = kDidNotArise;
  answers.erase("i2");
  answers.erase("i3");
  const ChecklistScore s = scoreOf(marked(list, noFigures, answers));
  EXPECT_EQ(s.done, 20);
  EXPECT_EQ(s.open, 2);
  EXPECT_NEAR(s.low, 20.0 / 23, 1e-12);
  EXPECT_NEAR(s.high, 22.0 / 23, 1e-12);
  const Verdict v = judge(kAssessed, list, noFigures, answers, nullptr, {}, 0.98);
  EXPECT_EQ(v.status, Status::failed);  // at most 22 of 23, whatever is said of the other two
  EXPECT_EQ(judge(kAssessed, list, noFigures, answers, nullptr, {}, 0.90).status,
            Status::not_certified);
}

TEST(Verdict, StandardsOfNinetyEightAndNinetyPercent) {
  const Checklist list = listOf(50, 40);
  const GlobalRating global = shippedGlobal();
  Answers answers = all(list, kDone);
  const auto at = [&](double standard) {
    return judge(kAssessed, list, noFigures, answers, &global, grades(global, 4), standard).status;
  };
  answers["i49"] = kNotDone;  // 49 of 50 are 98 %
  EXPECT_EQ(at(0.98), Status::passed);
  answers["i48"] = kNotDone;
  EXPECT_EQ(at(0.98), Status::failed);
  EXPECT_EQ(at(0.90), Status::passed);
  for (const char* id : {"i45", "i46", "i47"}) answers[id] = kNotDone;  // 45 of 50 are 90 %
  EXPECT_EQ(at(0.90), Status::passed);
  answers["i44"] = kNotDone;
  EXPECT_EQ(at(0.90), Status::failed);
}

TEST(Verdict, LevelsCountMajorAndMinorItems) {
  const Checklist list = listOf(24, 18);
  const auto level = [&](int major, int minor) {
    Answers answers = all(list, kNotDone);
    for (int i = 0; i < major; ++i) answers["i" + std::to_string(i)] = kDone;
    for (int i = 18; i < 18 + minor; ++i) answers["i" + std::to_string(i)] = kDone;
    return std::string(levelOf(scoreOf(marked(list, noFigures, answers)), list));
  };
  EXPECT_EQ(level(17, 5), "competent");
  EXPECT_EQ(level(16, 6), "borderline");
  EXPECT_EQ(level(17, 4), "borderline");
  EXPECT_EQ(level(10, 2), "borderline");
  EXPECT_EQ(level(9, 6), "below borderline");
  EXPECT_EQ(level(18, 1), "below borderline");
}

TEST(Verdict, ANeedleThatWasNeverInsertedHasDoneNothingWell) {
  const Checklist list = shippedChecklist();
  const assess::TrialAssessment a =
      assess::assessTrial(assess::test::facts("time"), assess::test::Motion(200).hold(3).samples(),
                          referencePatient(anatomy::Side::right),
                          assess::OrganDistance(assess::test::nowhere), shippedPath(), {});
  for (const MarkedItem& m : marked(list, figuresOf(a), {}))
    EXPECT_NE(m.mark, Mark::done) << m.item->id;
}

/// What nobody asked in an older trial, a rater may have heard.
TEST(Verdict, ARaterSaysWhatNoFigureWasKeptOf) {
  const Checklist list = shippedChecklist();
  Answers said = ratersItemsDone(list);
  said["dark"] = kDone;
  EXPECT_EQ(judge(kAssessed, list, noFigures, said, nullptr, {}, 0.98).score.open, 17);
}

TEST(Verdict, AFigureThatAnOldRecordLacksLeavesTheItemOpen) {
  const Checklist list = shippedChecklist();
  const Verdict v = judge(kAssessed, list, noFigures, ratersItemsDone(list), nullptr, {}, 0.98);
  EXPECT_EQ(v.status, Status::not_certified);
  EXPECT_EQ(v.score.open, 18);
  EXPECT_TRUE(v.critical.empty());
}

// Four rows: acceptable and unacceptable rate of failure, shortest run without a failure.
TEST(Certification, SaysWhatFewTrialsCannotCertify) {
  std::vector<int> runs;
  for (const Certification& c : certifications()) runs.push_back(c.limits.shortest_clean_run);
  EXPECT_EQ(runs, (std::vector<int>{13, 19, 20, 41}));
  EXPECT_NE(whatCannotBeCertified(1).find(
                "1 trial cannot certify anybody. The fewest trials in a row without a failure "
                "(sequential test, chances of error 0.1 each): 13 for a rate of failure of 10 % "
                "against 25 %, 19 "),
            std::string::npos)
      << whatCannotBeCertified(1);
  EXPECT_NE(whatCannotBeCertified(10).find("10 trials cannot certify anybody"), std::string::npos);
  EXPECT_NE(whatCannotBeCertified(19).find(
                "19 trials without a failure are enough for some rates (13 for"),
            std::string::npos)
      << whatCannotBeCertified(19);
  EXPECT_NE(whatCannotBeCertified(41).find("41 trials without a failure are enough for every rate"),
            std::string::npos)
      << whatCannotBeCertified(41);
}

}  // namespace
}  // namespace palpa::competence::test
