#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "csv_rows.h"
#include "program.h"
#include "tests/support/counts.h"

/// A palpation session, as an educator runs it.
namespace palpa::cli_test {
namespace {

double sum(const std::vector<Row>& rows, const char* name) {
  double all = 0;
  for (const Row& row : rows) all += std::stod(row.at(name));
  return all;
}

std::vector<std::string> palpation(std::vector<std::string> more) {
  more.insert(more.begin(), "palpation");
  return quickly(more);
}

std::vector<Row> searched(const std::string& who, int trials, const Folder& here,
                          const std::string& preset = "breast", const std::string& seed = "1") {
  const Outcome outcome = palpa(palpation({"--preset", preset, "--operator", who, "--seed", seed,
                                           "--trials", std::to_string(trials), "--out", who}),
                                here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? rowsOf(contentOf(here / (who + "/trials.csv")))
                                : std::vector<Row>{};
}

double wilsonLower(double hits, double of) {
  constexpr double z = 1.96;
  const double p = hits / of;
  return (p + z * z / (2 * of) - z * std::sqrt(p * (1 - p) / of + z * z / (4 * of * of))) /
         (1 + z * z / of);
}

/// Experts find what is there and little else; novices do clearly worse. Few cases bound less, so
/// they are bound less tightly.
TEST(Palpation, ExpertsFindLumpsAndNovicesMissThem) {
  const Folder here;
  const int trials = test::counted(2, 100);
  const std::string seed = test::counted("4", "1");  // the fourth case and the fifth have lumps
  const std::vector<Row> expert = searched("expert", trials, here, "breast", seed),
                         novice = searched("novice", trials, here, "breast", seed);
  ASSERT_EQ(expert.size(), static_cast<std::size_t>(trials));
  const double lumps = sum(expert, "LUMPS"), found = sum(expert, "FOUND"),
               clear = sum(expert, "CLEAR_QUADRANTS"), wrong = sum(expert, "WRONG_QUADRANTS");
  EXPECT_EQ(lumps, sum(novice, "LUMPS")) << "the same cases";
  if (test::fullCounts()) {
    EXPECT_GE(lumps, 100);
    EXPECT_GE(found / lumps, 0.9);
    EXPECT_GE(wilsonLower(found, lumps), 0.8);
    EXPECT_LT(sum(novice, "FOUND") / lumps, found / lumps - 0.15);
  }
  EXPECT_GE(found / lumps, 0.66);
  EXPECT_GT(1 - wrong / clear, 0.8);
  EXPECT_LT(sum(novice, "COVERAGE_LIGHT"), 0.8 * sum(expert, "COVERAGE_LIGHT"));
  int strips = 0, done = 0;
  for (const Row& row : expert) {
    EXPECT_EQ(row.at("SIMULATED"), "1");
    strips += row.at("PATTERN") == "vertical strips";
    done += row.at("OUTCOME") == "done";
  }
  EXPECT_GT(2 * strips, trials) << "closer looks break the pattern now and then, not as a rule";
  EXPECT_GT(2 * done, trials) << "five minutes are enough";
}

/// Who knows the anatomy takes the liver's edge for what it is; who does not takes it for a lump.
TEST(Palpation, TheLiversEdgeIsNoLump) {
  const Folder here;
  const int trials = test::counted(2, 24);
  const std::string seed = "2401";  // of a few, one that tells in two cases, too
  const std::vector<Row> expert = searched("expert", trials, here, "abdomen", seed),
                         novice = searched("novice", trials, here, "abdomen", seed);
  ASSERT_EQ(expert.size(), static_cast<std::size_t>(trials));
  ASSERT_EQ(novice.size(), static_cast<std::size_t>(trials));
  EXPECT_LE(sum(expert, "FALSE_ALARMS"), 0.34 * trials);
  EXPECT_GE(sum(novice, "FALSE_ALARMS"), 0.5 * trials);
  EXPECT_GT(sum(expert, "FOUND"), sum(novice, "FOUND"));
  EXPECT_GE(sum(expert, "FOUND"), 0.6 * sum(expert, "LUMPS"));
  EXPECT_TRUE(
      says(contentOf(here / "novice/report.html"), "What belongs there runs on to both sides"));
}

/// A lump lies in the silicone in every case; where it is taken away it is no lump, and what is
/// pushed for it is in the ticks, which run again the same.
TEST(Palpation, ARealLumpIsTakenAwayInSomeCases) {
  const Folder here;
  const std::string near_the_lump = taskWith(
      "palpation_taken",
      {{"area", {{"half_across_mm", 15}, {"half_away_mm", 15}}}, {"cases", {{"lumps", {1}}}}},
      here);
  const Outcome outcome =
      palpa({"palpation", "--task", near_the_lump, "--operator", "expert", "--seed", "1",
             "--trials", "4", "--fast", "--no-views", "--tracking", "model", "--out", "taken"},
            here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "N/m would be passive"));
  EXPECT_LT(outcome.out.find("N/m would be passive"), outcome.out.find("report.html"));
  EXPECT_TRUE(says(contentOf(here / "taken/report.html"), "N/m would be passive"));
  const Outcome again = palpa({"replay", "taken/session.palpa"}, here.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(says(again.out, ": 0 differ"));
  const Outcome two =
      palpa(palpation({"--preset", "taken", "--tools", "2", "--operator", "expert"}), here.path());
  EXPECT_EQ(two.exit_code, 2);
}

TEST(Palpation, ReplayJudgesItAgain) {
  const Folder here;
  ASSERT_EQ(palpa(palpation({"--operator", "expert", "--preset", "prostate", "--seed", "3", "--out",
                             "A"}),
                  here.path())
                .exit_code,
            0);
  const Outcome outcome = palpa({"replay", "A/session.palpa"}, here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "The replay equals the record"));
  EXPECT_TRUE(says(outcome.out, ": 0 differ"));
  // Cells of 10 mN of noise, a sensor whose bias is known to 5 mN an axis (standard deviations), a
  // phantom that gives some 0.9 N.
  const std::string words = "add up to m a: within ";
  const std::size_t at = outcome.out.find(words);
  ASSERT_NE(at, std::string::npos) << outcome.out;
  EXPECT_LE(std::stod(outcome.out.substr(at + words.size())), 0.05);
}

TEST(Palpation, TheSameSeedGivesTheSameNumbersAndViewsChangeNone) {
  const Folder here;
  ASSERT_EQ(palpa(palpation({"--operator", "novice", "--preset", "prostate", "--seed", "5", "--out",
                             "A"}),
                  here.path())
                .exit_code,
            0);
  ASSERT_EQ(palpa({"palpation", "--fast", "--quiet", "--operator", "novice", "--preset", "prostate",
                   "--seed", "5", "--out", "B"},
                  here.path())
                .exit_code,
            0);
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(here / "B/trials.csv"));
  const std::string page = contentOf(here / "B/report.html");
  for (const char* words :
       {"SIMULATED", "Deep is ", "Where this task stands", "real silicone, a virtual lump"})
    EXPECT_TRUE(says(page, words)) << words;
  bool pictures = false;
  for (const std::string& file : here.files()) pictures = pictures || says(file, "-end.png");
  EXPECT_TRUE(pictures);
}

TEST(Palpation, SeeingTheLumpsDoesNotCount) {
  const Folder here;
  ASSERT_EQ(palpa(palpation({"--operator", "novice", "--preset", "prostate", "--see-through", "on",
                             "--out", "A"}),
                  here.path())
                .exit_code,
            0);
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "Not counted: not scored"));
  EXPECT_TRUE(rowsOf(contentOf(here / "A/trials.csv")).empty());
}

TEST(Palpation, ATaskFileIsEnough) {
  const Folder here;
  const std::string task = std::string(PALPA_SOURCE_DIR) + "/assets/tasks/palpation_prostate.json";
  ASSERT_EQ(palpa(palpation({"--task", task, "--operator", "novice", "--seed", "5", "--out", "A"}),
                  here.path())
                .exit_code,
            0);
  ASSERT_EQ(palpa(quickly({"train", "--task", task, "--operator", "novice", "--seed", "5",
                           "--station", quickStation("palpation_bench.json"), "--out", "B"}),
                  here.path())
                .exit_code,
            0);
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(here / "B/trials.csv"));
  const Outcome outcome = palpa(
      {"train", "--task", task, "--fast", "--operator", "novice", "--side", "left"}, here.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(says(outcome.err, "--side")) << outcome.err;
}

/// A bit of the neck, with a lump or two: session, report and replay follow its surface, and what a
/// lump adds is told with the way out of the surface over it.
TEST(Palpation, ACurvedPhantomIsPalpatedLikeAFlatOne) {
  const Folder here;
  const std::filesystem::path assets = std::filesystem::path(PALPA_SOURCE_DIR) / "assets";
  nlohmann::json task = nlohmann::json::parse(contentOf(assets / "tasks/palpation_neck.json"));
  task["lumps"] = (assets / "materials/lumps.json").string();
  task["area"] = {{"half_across_mm", 14},
                  {"half_away_mm", 10},
                  {"outline_mm", {{4, -10}, {14, -10}, {14, 10}, {4, 10}}}};
  task["cases"]["lumps"] = {0, 1};
  task["cases"]["kinds"] = {"middle"};
  const std::string file = here.file("neck.json", task.dump());
  const Outcome held =
      palpa(palpation({"--task", file, "--operator", "expert", "--seed", "3", "--out", "A"}),
            here.path());
  ASSERT_EQ(held.exit_code, 0) << held.err;
  const std::vector<Row> rows = rowsOf(contentOf(here / "A/trials.csv"));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_GT(std::stod(rows[0].at("COVERAGE_LIGHT")), 0.9);
  EXPECT_GT(std::stod(rows[0].at("COVERAGE_DEEP")), 0.9) << "pressed along the normal";
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "class=\"contour\""));
  const Outcome again = palpa({"replay", "A/session.palpa"}, here.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(says(again.out, ": 0 differ")) << again.out;
  ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "ticks.csv"}, here.path()).exit_code, 0);
  const nlohmann::json laws = nlohmann::json::parse(contentOf(here / "ticks.laws.json"));
  const nlohmann::json& normal = laws.at("lumps").at("1").at(0).at("normal");
  EXPECT_GT(normal.at(2).get<double>(), 0.7);
  EXPECT_LT(normal.at(2).get<double>(), 0.9999);
  const Outcome two =
      palpa(palpation({"--task", file, "--tools", "2", "--operator", "expert"}), here.path());
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_TRUE(says(two.err, "flat top")) << two.err;
}

TEST(Palpation, WrongUsageIsNamed) {
  const Folder here;
  const Outcome station = palpa(
      palpation({"--station", std::string(PALPA_SOURCE_DIR) + "/assets/stations/virtual_bench.json",
                 "--operator", "expert"}),
      here.path());
  EXPECT_EQ(station.exit_code, 2);
  EXPECT_TRUE(says(station.err, "\"sample\"")) << station.err;
  const Outcome needle =
      palpa(palpation({"--task", std::string(PALPA_SOURCE_DIR) + "/assets/tasks/paracentesis.json",
                       "--operator", "expert"}),
            here.path());
  EXPECT_EQ(needle.exit_code, 2);
  EXPECT_TRUE(says(needle.err, "engine")) << needle.err;
  EXPECT_EQ(palpa({"palpation", "--display", "openxr"}, here.path()).exit_code, 2);
}

}  // namespace
}  // namespace palpa::cli_test
