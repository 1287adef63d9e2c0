#include <gtest/gtest.h>

#include <cmath>

#include "apps/assess/palpation/coverage_map.h"
#include "apps/assess/palpation/palpation_assessment.h"
#include "apps/assess/palpation/palpation_score.h"
#include "apps/assess/palpation/palpation_words.h"
#include "apps/training/trial_words.h"
#include "searches.h"

namespace palpa::assess {
namespace {

using training::Outcome;

CaseLump aLump(double x, double y, double diameter = 0.016) {
  return {Vec3(x, y, -0.014), diameter, 2, 1};
}
LumpMark aMark(double x, double y) { return {10, Vec3(x, y, -0.004), 0.020, 2, 2}; }

const Search& thorough() {
  static const Search search = inStrips(0.034, 0.0085, 1.3);
  return search;
}

PalpationAssessment assessed(const std::vector<CaseLump>& lumps, const std::vector<LumpMark>& marks,
                             const Search& search = thorough(),
                             const std::string& outcome = "done") {
  PalpationFacts facts;
  facts.outcome = training::outcomeNamed(outcome);
  return assessPalpation(facts, {}, {}, lumps, search.samples(), marks);
}

/// The place of the first advice with these words; -1: none.
int adviceWith(const PalpationAssessment& assessment, const std::string& words) {
  for (std::size_t i = 0; i < assessment.advice.size(); ++i)
    if (assessment.advice[i].find(words) != std::string::npos) return static_cast<int>(i);
  return -1;
}

TEST(PalpationSummary, CountsInWords) {
  const std::vector<CaseLump> three{aLump(0.02, 0.02), aLump(-0.02, -0.02), aLump(0.02, -0.02)};
  EXPECT_EQ(assessed(three, {aMark(0.02, 0.02), aMark(-0.02, -0.02), aMark(-0.02, 0.025)}).summary,
            "Found 2 of 3 lumps, one false alarm; 100 % of the area was felt.");
  EXPECT_EQ(assessed(three, {}).summary,
            "Found none of 3 lumps, no false alarm; 100 % of the area was felt.");
  EXPECT_EQ(assessed(three, {aMark(0.02, 0.02), aMark(-0.02, -0.02), aMark(0.02, -0.02)}).summary,
            "Found all 3 lumps, no false alarm; 100 % of the area was felt.");
  EXPECT_EQ(assessed({three[0], three[1]}, {aMark(0.02, 0.02), aMark(-0.02, -0.02)}).summary,
            "Found both lumps, no false alarm; 100 % of the area was felt.");
  EXPECT_EQ(assessed({three[0]}, {aMark(0.02, 0.02)}).summary,
            "Found the only lump, no false alarm; 100 % of the area was felt.");
  EXPECT_EQ(assessed({three[0]}, {aMark(-0.02, 0.02), aMark(-0.02, -0.02)}).summary,
            "Missed the only lump, 2 false alarms; 100 % of the area was felt.");
}

TEST(PalpationSummary, KnowsCasesWithoutLumpsAndHowItEnded) {
  EXPECT_EQ(assessed({}, {}).summary,
            "There was no lump, and none was marked; 100 % of the area was felt.");
  EXPECT_EQ(assessed({}, {aMark(0, 0)}).summary,
            "There was no lump, but one was marked; 100 % of the area was felt.");
  EXPECT_EQ(assessed({}, {aMark(0, 0), aMark(0.01, 0)}).summary,
            "There was no lump, but 2 were marked; 100 % of the area was felt.");
  EXPECT_EQ(
      assessed({}, {}, thorough(), "time").summary,
      "There was no lump, and none was marked; 100 % of the area was felt when time ran out.");
  EXPECT_EQ(assessed({}, {}, thorough(), "aborted").summary,
            "There was no lump, and none was marked; 100 % of the area was felt when the search "
            "was stopped early.");
  const PalpationAssessment none = assessed({aLump(0, 0)}, {}, thorough(), "void");
  EXPECT_EQ(none.summary, "This search is void and does not count.");
  EXPECT_TRUE(none.advice.empty());
}

TEST(PalpationPass, NeedsLumpsAreaAndAnEnd) {
  const CaseLump lump = aLump(0.02, 0.02);
  const LumpMark mark = aMark(0.02, 0.02);
  EXPECT_TRUE(assessed({lump}, {mark}).passed);
  EXPECT_TRUE(assessed({lump}, {mark}, thorough(), "time").passed);
  EXPECT_TRUE(assessed({lump}, {mark, aMark(-0.02, -0.02)}).passed);  // false alarms fail nobody
  EXPECT_TRUE(assessed({}, {}).passed);
  EXPECT_FALSE(assessed({lump}, {}).passed);
  EXPECT_FALSE(assessed({lump}, {mark}, thorough(), "aborted").passed);
  EXPECT_FALSE(assessed({lump}, {mark}, thorough(), "void").passed);
  EXPECT_FALSE(
      assessed({lump}, {mark}, inStrips(0.034, 0.017, 1.3)).passed);  // gaps between the strips
  PalpationStandard half;
  half.sensitivity = 0.5;
  half.coverage = 0.3;
  EXPECT_TRUE(assessPalpation({}, {}, half, {lump, aLump(-0.02, -0.02)},
                              inStrips(0.034, 0.017, 1.3).samples(), {mark})
                  .passed);
}

/// Strips of the right half at one force each: what is left is never felt, and what is felt is felt
/// so firmly.
TEST(PalpationAdvice, TellsWhyALumpWasMissed) {
  const auto right = [](double force) {
    Search search;
    for (double x = 0.0045; x < 0.036; x += 0.0085)
      for (double y = -0.034; y < 0.035; y += 0.0085) search.press(x, y, force);
    return search;
  };
  const std::vector<CaseLump> two{aLump(0.02, 0.02, 0.012), aLump(-0.02, 0.02)};
  const PalpationAssessment light = assessed(two, {}, right(0.5));
  ASSERT_GE(light.advice.size(), 2u);
  EXPECT_EQ(
      light.advice[0].find("One lump (16 mm, back left) was missed: its middle was never felt."),
      0u)
      << light.advice[0];
  EXPECT_EQ(light.advice[1].find(
                "One lump (12 mm, back right) was missed: its place was felt, but only lightly."),
            0u)
      << light.advice[1];
  EXPECT_GE(adviceWith(assessed(two, {}, right(0.9)), "medium pressure, but never deeply"), 0);
  EXPECT_GE(adviceWith(assessed(two, {}, right(1.5)), "felt firmly, but passed over"), 0);
  EXPECT_EQ(assessed(two, {}).advice[0].find("2 lumps (12 mm, back right; 16 mm, back left) were "
                                             "missed: their places were felt firmly"),
            0u);
  EXPECT_EQ(adviceWith(assessed(two, {aMark(0.02, 0.02), aMark(-0.02, 0.02)}), "missed:"), -1);
}

TEST(PalpationAdvice, NamesFalseAlarmsThenWhatWasNotFelt) {
  Search far;
  for (double x = -0.034; x < 0.035; x += 0.0085)
    for (double y = 0.0045; y < 0.036; y += 0.0085) far.press(x, y, 1.3);
  const PalpationAssessment half =
      assessed({aLump(0.02, 0.02)}, {aMark(-0.02, 0.02), aMark(0, 0.001)}, far);
  const int missed = adviceWith(half, "was missed"),
            alarms = adviceWith(half, "2 marks were no lumps (back left and in the middle)"),
            area = adviceWith(half, "mainly front left and front right");
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(alarms, 1);
  EXPECT_EQ(area, 2);
  EXPECT_EQ(adviceWith(assessed({}, {}), "of the area was felt"), -1);
  EXPECT_GE(adviceWith(assessed({}, {}, Search{}), "Nothing was felt"), 0);
}

TEST(PalpationAdvice, TellsOfForcePatternAndCloserLooks) {
  EXPECT_TRUE(assessed({}, {}).advice.empty()) << assessed({}, {}).advice[0];
  EXPECT_GE(
      adviceWith(assessed({}, {}, inStrips(0.034, 0.0085, 3.2)), "Pressed too hard: above 2.5 N"),
      0);
  EXPECT_GE(adviceWith(assessed({}, {}, inStrips(0.034, 0.0085, 0.33)),
                       "Pressed too lightly: below 0.3 N"),
            0);
  EXPECT_GE(adviceWith(assessed({}, {}, inStrips(0.034, 0.0085, 0.9)),
                       "Only 0 % of the area was felt deeply (1.2 N or more)"),
            0);
  Search wild;
  for (int i = 0; i < 40; ++i)
    wild.press(0.03 * std::sin(7.3 * i * i), 0.03 * std::cos(3.1 * i * i + 1), 1);
  EXPECT_GE(adviceWith(assessed({}, {}, wild), "No pattern was recognised"), 0);
  const auto closer = [](double force) {
    Search search = thorough();
    for (int i = 0; i < 5; ++i) search.press(0.01, 0.01, force);
    return search;
  };
  EXPECT_GE(adviceWith(assessed({}, {}, closer(1.3)), "no more force than the search"), 0);
  EXPECT_EQ(adviceWith(assessed({}, {}, closer(1.5)), "no more force than the search"), -1);
}

/// The counts of the score are the counts of the meanings.
TEST(MarkMeaning, AgreesWithTheScore) {
  const std::vector<CaseLump> lumps{aLump(0, 0), aLump(0.02, 0.02)};
  const std::vector<LumpMark> marks{aMark(0.001, 0), aMark(-0.006, 0), aMark(-0.03, -0.03),
                                    aMark(0.02, 0.021)};
  const PalpationScore score = scorePalpation({}, lumps, {}, marks);
  std::array<int, 3> counts{};
  for (std::size_t i = 0; i < marks.size(); ++i)
    ++counts[static_cast<std::size_t>(meaningOf(i, {}, score, lumps, marks))];
  EXPECT_EQ(meaningOf(1, {}, score, lumps, marks), MarkMeaning::repeated);
  EXPECT_EQ(meaningOf(2, {}, score, lumps, marks), MarkMeaning::false_alarm);
  EXPECT_EQ(counts, (std::array<int, 3>{score.found, score.repeated, score.false_alarms}));
}

TEST(PlaceWords, FarIsAwayFromTheTrainee) {
  const SearchArea area;
  EXPECT_EQ(placeWords(area, Vec3(-0.02, 0.02, 0)), "back left");
  EXPECT_EQ(placeWords(area, Vec3(0.02, 0.02, 0)), "back right");
  EXPECT_EQ(placeWords(area, Vec3(-0.02, -0.02, 0)), "front left");
  EXPECT_EQ(placeWords(area, Vec3(0.02, -0.02, 0)), "front right");
  EXPECT_EQ(placeWords(area, Vec3(0.008, -0.008, 0)), "in the middle");
}

TEST(Judgement, TakesEightCasesThatCount) {
  const PalpationAssessment found = assessed({aLump(0, 0)}, {aMark(0, 0)}),
                            missed = assessed({aLump(0, 0)}, {}), empty = assessed({}, {});
  PalpationAssessment guided = found, interrupted = found;
  guided.facts.role = training::Role::not_scored;
  interrupted.facts.outcome = training::Outcome::voided;
  std::vector<PalpationAssessment> trials(7, found);
  trials.push_back(guided);
  trials.push_back(interrupted);
  EXPECT_EQ(judgementOf(trials, {}).verdict, PalpationVerdict::too_few_cases);
  EXPECT_EQ(judgementOf(trials, {}).cases, 7);
  trials.push_back(found);
  EXPECT_EQ(judgementOf(trials, {}).verdict, PalpationVerdict::passed);
  trials.push_back(missed);
  EXPECT_EQ(judgementOf(trials, {}).verdict, PalpationVerdict::not_passed)
      << "8 of 9 are less than 90 %";
  trials.push_back(found);
  EXPECT_EQ(judgementOf(trials, {}).verdict, PalpationVerdict::passed) << "9 of 10";
  for (PalpationAssessment& trial : trials) trial.score.coverage[0] = 0.94;
  EXPECT_EQ(judgementOf(trials, {}).verdict, PalpationVerdict::not_passed);
  EXPECT_EQ(judgementOf(std::vector<PalpationAssessment>(9, empty), {}).verdict,
            PalpationVerdict::no_lump)
      << "nothing could be missed";
}

PalpationStandard strict() {
  PalpationStandard standard;
  standard.deep_coverage = 0.95;
  standard.false_alarms = 1;
  return standard;
}

TEST(PalpationPass, AsksForDepthAndFewFalseAlarmsWhereTheTaskDoes) {
  const CaseLump lump = aLump(0.02, 0.02);
  const LumpMark mark = aMark(0.02, 0.02), wrong = aMark(-0.02, -0.02);
  PalpationFacts facts;
  facts.outcome = Outcome::done;
  const auto below = [&](const std::vector<LumpMark>& marks, double force) {
    const PalpationAssessment trial = assessPalpation(
        facts, {}, strict(), {lump}, inStrips(0.034, 0.0085, force).samples(), marks);
    EXPECT_EQ(trial.passed, trial.below.empty());
    return trial.below;
  };
  using All = std::vector<Shortfall>;
  EXPECT_EQ(below({mark}, 1.3), All{});
  EXPECT_EQ(below({mark, wrong}, 1.3), All{});
  EXPECT_EQ(below({mark, wrong, wrong}, 1.3), All{Shortfall::false_alarms});
  EXPECT_EQ(below({mark}, 0.5), All{Shortfall::deep_coverage});
  EXPECT_EQ(below({}, 0.5), (All{Shortfall::sensitivity, Shortfall::deep_coverage}));
  EXPECT_EQ(standardWords(strict()),
            "90 % of the lumps and 95 % of the area, 95 % of it deeply, with no more than 1 false "
            "alarm a case");
  EXPECT_EQ(standardWords({}), "90 % of the lumps and 95 % of the area");
}

/// Who marks every quarter of every case finds all lumps, and does not pass.
TEST(PalpationPass, MarkingEverythingIsNoDiscrimination) {
  const std::vector<LumpMark> everywhere{aMark(0.02, 0.02), aMark(-0.02, 0.02), aMark(0.02, -0.02),
                                         aMark(-0.02, -0.02)};
  std::vector<PalpationAssessment> trials;
  for (int i = 0; i < 8; ++i)
    trials.push_back(
        assessed(i % 4 == 0 ? std::vector<CaseLump>{} : std::vector<CaseLump>{aLump(0.02, 0.02)},
                 everywhere));
  const PalpationJudgement judged = judgementOf(trials, strict());
  EXPECT_EQ(judged.verdict, PalpationVerdict::not_passed);
  EXPECT_EQ(judged.below, std::vector<Shortfall>{Shortfall::false_alarms});
  EXPECT_EQ(judged.reached.sensitivity, 1);
  EXPECT_EQ(judged.reached.false_alarms, 3.25);
  const statistics::Detections& quarters = judged.quarters;
  EXPECT_EQ(quarters.signals, 6);
  EXPECT_EQ(quarters.hits, 6);
  EXPECT_EQ(quarters.rest, 2 * 4 + 6 * 3);
  EXPECT_EQ(quarters.alarms, quarters.rest);
  EXPECT_LT(statistics::discriminationOf(quarters).criterion, -1.5);
  EXPECT_LT(std::abs(statistics::discriminationOf(quarters).d), 0.7);
}

TEST(PalpationPass, NeedsACaseThatCanBeLeftAloneWhereFalseAlarmsCount) {
  const std::vector<PalpationAssessment> trials(9,
                                                assessed({aLump(0.02, 0.02)}, {aMark(0.02, 0.02)}));
  EXPECT_EQ(judgementOf(trials, {}).verdict, PalpationVerdict::passed);
  EXPECT_EQ(judgementOf(trials, strict()).verdict, PalpationVerdict::no_clear_case);
}

}  // namespace
}  // namespace palpa::assess
