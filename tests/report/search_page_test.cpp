#include <gtest/gtest.h>

#include "apps/training/trial_words.h"
#include "synthetic_search_report.h"
#include "tests/support/files.h"
#include "well_formed.h"

namespace palpa::report {

using training::Outcome;

namespace {

using assess::SearchMode;

std::string searchPage(const SearchReport& report, const std::string& name = "page") {
  const std::filesystem::path file =
      palpa::test::freshFolder("report", "search_" + name) / "report.html";
  writeSearchReport(report, file);
  std::string page = palpa::test::slurp(file);
  EXPECT_EQ(test::faultOf(page), "");
  return page;
}

bool holds(const std::string& page, const std::string& words) {
  return page.find(words) != std::string::npos;
}

std::size_t timesIn(const std::string& page, const std::string& words) {
  std::size_t times = 0;
  for (std::size_t at = page.find(words); at != std::string::npos; at = page.find(words, at + 1))
    ++times;
  return times;
}

TEST(SearchPage, SaysWhatWasFoundAndWhatTheCuesGaveBack) {
  const std::string page = searchPage(test::searchedSession());
  for (const char* words :
       {"In 10 of 10 episodes with full stiffness the target was found, 95 % interval 72 % to 100 "
        "%. The choice took 14 s (median).",
        "In 4 of 10 episodes with degraded stiffness the target was found, 95 % interval 17 % to "
        "69 %. That may have been chance. The choice took 37 s (median).",
        "In 8 of 10 episodes with degraded stiffness and cues the target was found, 95 % interval "
        "49 % to 94 %. The choice took 23 s (median).",
        "Of what is lost without full stiffness, the cues gave back 67 %, 95 % interval",
        "1 U = 0.06 mm in the hand", "Made by palpa 0.1.0."})
    EXPECT_TRUE(holds(page, words)) << words;
  for (const char* words :
       {"SIMULATED", "not counted", "All blocks are taken together", "no force feedback"})
    EXPECT_FALSE(holds(page, words)) << words;
}

TEST(SearchPage, EveryEpisodeHasARowAMarkAndASignOfItsPlace) {
  const std::string page = searchPage(test::searchedSession());
  EXPECT_EQ(timesIn(page, "<tr id=\"trial-"), 30u);
  EXPECT_EQ(timesIn(page, "class=\"place\""), 30u);
  EXPECT_EQ(timesIn(page, "element target"), 30u);
  EXPECT_EQ(timesIn(page, "choice other"), 8u);
  EXPECT_EQ(timesIn(page, "class=\"mark good\""), 2 * (22 + 1u))
      << "wide and narrow, and one in the key";
  EXPECT_EQ(timesIn(page, "class=\"mark bad\""), 2 * (8 + 1u));
}

/// The target is the first element, which lies where the triangle points.
TEST(SearchPage, TheTargetIsDrawnWhereItLay) {
  SearchReport report = test::searchedSession();
  report.trials = {report.trials[2]};
  report.trials[0].orientation_deg = 90;
  const std::string page = searchPage(report);
  EXPECT_TRUE(holds(page, "<title>Target at the top, chosen</title>"));
  EXPECT_TRUE(holds(page, "class=\"element target\" cx=\"24\" cy=\"10.7\""));
  report.trials[0].orientation_deg = 0;
  report.trials[0].chosen = 1;
  EXPECT_TRUE(holds(searchPage(report), "Target at the right, chosen the one at the upper left"));
}

TEST(SearchPage, DosesAreSummedByStiffness) {
  const std::string page = searchPage(test::searchedSession());
  EXPECT_EQ(timesIn(page, "class=\"parts\""), 3u);
  EXPECT_TRUE(holds(page, "Degraded, with cues, 10 episodes"));
  EXPECT_EQ(timesIn(page, "Added in all</th>"), 1u) << "only where a cue was felt";
  EXPECT_TRUE(holds(page, "20.0 s</td>\n<td>30.00 N s</td>\n<td>1.50 N"));
  EXPECT_TRUE(holds(page, "the probe moves slowly, along a groove or a pit"));
  SearchReport without = test::searchedSession();
  for (assess::SearchTrial& trial : without.trials) trial.doses.clear();
  EXPECT_FALSE(holds(searchPage(without), "The parts of the task"));
}

TEST(SearchPage, SaysWhenNothingCanBeToldOfTheCues) {
  SearchReport report = test::searchedSession();
  std::erase_if(report.trials,
                [](const assess::SearchTrial& t) { return t.mode == SearchMode::real; });
  EXPECT_TRUE(holds(searchPage(report), "only by episodes of all three kinds"));
  std::erase_if(report.trials,
                [](const assess::SearchTrial& t) { return t.mode == SearchMode::augmented; });
  EXPECT_FALSE(holds(searchPage(report), "class=\"recovered\""));
  report = test::searchedSession();
  for (assess::SearchTrial& t : report.trials)
    if (t.mode == SearchMode::degraded) t.chosen = t.target;
  EXPECT_TRUE(holds(searchPage(report), "nothing was lost that cues could give back"));
  report.trials.resize(6);
  report.trials[1].chosen = (report.trials[1].target + 1) % 3;
  EXPECT_TRUE(holds(searchPage(report), "too alike, or there were too few"));
}

TEST(SearchPage, BlocksAndUnscoredEpisodesAreTold) {
  SearchReport report = test::searchedSession();
  for (std::size_t i = 0; i < 6; ++i)
    report.trials[i].block = "training", report.trials[i].role = training::Role::familiarisation;
  for (std::size_t i = 6; i < 18; ++i) report.trials[i].block = "baseline";
  for (std::size_t i = 18; i < 30; ++i) report.trials[i].block = "evaluation";
  report.trials[6].outcome = Outcome::time;
  report.trials[6].chosen = -1;
  report.trials[9].force_feedback = false;
  const std::string page = searchPage(report);
  EXPECT_TRUE(holds(page, "Block baseline: in 3 of 4 episodes with full stiffness"));
  EXPECT_TRUE(holds(page, "In 1 of them nothing was chosen."));
  EXPECT_TRUE(holds(page, "All blocks are taken together"));
  EXPECT_FALSE(holds(page, "Block training"));
  EXPECT_EQ(timesIn(page, ">not counted<"), 6u);
  EXPECT_TRUE(holds(page, "6 episodes are not counted here"));
  EXPECT_TRUE(holds(page, "mark good hollow"));
  EXPECT_TRUE(holds(page, "none: time over"));
  EXPECT_TRUE(holds(page, "no force feedback"));
}

TEST(SearchPage, SimulatedIsSaidOnTopAndVoidIsNotCounted) {
  SearchReport report = test::searchedSession();
  for (assess::SearchTrial& trial : report.trials) trial.outcome = Outcome::voided;
  report.trials[4].simulated = true;
  const std::string page = searchPage(report);
  EXPECT_TRUE(holds(page, "SIMULATED"));
  EXPECT_TRUE(holds(page, "No episode counts"));
  EXPECT_FALSE(holds(page, "How long did it take?"));
  report = test::searchedSession();
  report.simulated = true;
  EXPECT_TRUE(holds(searchPage(report), "SIMULATED"));
  EXPECT_TRUE(holds(searchPage({}), "No episode counts"));
}

TEST(SearchPage, NoTextIsMarkup) {
  SearchReport report = test::searchedSession();
  const std::string hostile = "<script>\"x\" & 'y'</script>";
  report.title = report.trainee = report.unit_note = hostile;
  report.subtasks = {{hostile, hostile}};
  report.notes = {{hostile, hostile, hostile}};
  report.pictures = {{"/nowhere/<b>.png", hostile}};
  for (assess::SearchTrial& trial : report.trials) {
    trial.block = hostile;
    trial.doses[0].subtask = hostile;
  }
  const std::string page = searchPage(report, "hostile");
  EXPECT_FALSE(holds(page, "<script"));
  EXPECT_FALSE(holds(page, "<b>"));
  EXPECT_TRUE(holds(page, "&lt;script&gt;&quot;x&quot; &amp; &#39;y&#39;&lt;/script&gt;"));
}

/// Small, of made-up numbers; a cue between two places that are above the floor.
SearchFigures drawnFloor() {
  const MapValues map{2, 2, -120, 120, -120, 120, {0, -2, 1, 2}};
  SearchFigures f;
  f.trial = 3;
  f.mode = "augmented";
  f.unit_mm = 0.06;
  f.smooth = f.floor = f.response = map;
  f.target = {map, 2, 7, 5.6};
  f.distractor = {map, 1, 3, 2.4};
  f.filter = {map, 0.589, 3.75, 0.5};
  f.elements = {{0, 60, true, true}, {50, -30, false, false}, {-50, -30, false, false}};
  f.way = {{0, 0, false, 0}, {10, 0, true, 0}, {20, 0, true, 1}, {30, 0, false, 0}};
  f.cues = {"edge <&>"};
  return f;
}

TEST(SearchPage, TheFloorIsDrawnOnItAndAsFiles) {
  SearchReport report = test::searchedSession();
  EXPECT_FALSE(holds(searchPage(report), "stimulus, texture and response"));
  report.figures = drawnFloor();
  const std::string page = searchPage(report, "floor");
  for (const char* words :
       {"The floor of episode 3: stimulus, texture and response", "of radius 2 U on a grid of 7 U",
        "0.589 rad", "cue: edge &lt;&amp;&gt;", ">target<"})
    EXPECT_TRUE(holds(page, words)) << words;
  EXPECT_EQ(timesIn(page, "class=\"chart map\""), 7u);
  EXPECT_EQ(timesIn(page, "class=\"chosen\""), 1u);
  EXPECT_EQ(timesIn(page, "<path class=\"way cue-0\""), 1u);

  const auto folder = palpa::test::freshFolder("report", "search_figures");
  const std::vector<std::string> files = writeFigureFiles(*report.figures, folder);
  EXPECT_EQ(files.size(), 8u);
  for (const std::string& file : files)
    EXPECT_EQ(test::faultOf(palpa::test::slurp(folder / file)), "") << file;
  report.figures->way.clear();
  EXPECT_EQ(writeFigureFiles(*report.figures, folder).size(), 7u) << "no way, no picture of it";
}

TEST(SearchPage, LeavesOneToLookAt) { searchPage(test::searchedSession(), "example"); }

TEST(SearchCsv, ARowAnEpisode) {
  const std::filesystem::path file =
      palpa::test::freshFolder("report", "search_csv") / "trials.csv";
  assess::SearchTrial first = test::searched(4, SearchMode::augmented, true, 20),
                      second = test::searched(5, SearchMode::real, true, 8);
  first.block = "training";
  second.outcome = Outcome::time;
  second.chosen = -1;
  second.force_feedback = false;
  second.doses.erase(second.doses.begin());
  writeSearchCsv("T,7", {first, second}, file);
  EXPECT_EQ(palpa::test::slurp(file),
            "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,BLOCK,MODE,ORIENTATION_DEG,TARGET,CHOSEN,"
            "FOUND,TIME_S,PATH_M,MEAN_N,PEAK_N,VISIT_0_S,VISIT_1_S,VISIT_2_S,"
            "SCAN_ON_S,SCAN_TIMES,SCAN_AUGMENTED_S,SCAN_IMPULSE_NS,SHAPE_ASSESSMENT_ON_S,SHAPE_"
            "ASSESSMENT_TIMES,SHAPE_ASSESSMENT_AUGMENTED_S,SHAPE_ASSESSMENT_IMPULSE_NS,"
            "IDENTIFICATION_ON_S,IDENTIFICATION_TIMES,IDENTIFICATION_AUGMENTED_S,IDENTIFICATION_"
            "IMPULSE_NS\n"
            "\"T,7\",4,104,0,1,done,training,augmented,148,1,1,1,20,0.4,0.8,3.25,0,10,5,10,7,0.5,0."
            "25,5,4,2,3,2.5,5,0,0\n"
            "\"T,7\",5,105,0,0,time,,real,185,2,-1,0,8,0.16,0.8,3.25,2,0,4,,,,,2,4,0,0,1,5,0,0\n");
}

TEST(SearchCsv, WithoutEpisodesItIsAHeader) {
  const std::filesystem::path file =
      palpa::test::freshFolder("report", "search_csv_none") / "trials.csv";
  writeSearchCsv("T7", {}, file);
  const std::string csv = palpa::test::slurp(file);
  EXPECT_TRUE(csv.ends_with("VISIT_2_S\n"));
}

}  // namespace
}  // namespace palpa::report
