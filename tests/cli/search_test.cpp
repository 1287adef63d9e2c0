#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/assess/search/search_trial.h"
#include "apps/training/trial_words.h"
#include "csv_rows.h"
#include "guide_script.h"
#include "program.h"
#include "tests/support/counts.h"

/// The haptic search task, as an educator runs it.
namespace palpa::cli_test {
namespace {

std::vector<std::string> search(std::vector<std::string> more) {
  more.insert(more.begin(), "search");
  return quickly(more);
}

std::vector<Row> episodes(const std::vector<std::string>& more, const Folder& here) {
  const Outcome outcome = palpa(search(more), here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto out = std::find(more.begin(), more.end(), "--out");
  return outcome.exit_code == 0 ? rowsOf(contentOf(here / (*(out + 1) + "/trials.csv")))
                                : std::vector<Row>{};
}

std::vector<assess::SearchTrial> episodesOf(const std::vector<Row>& rows) {
  std::vector<assess::SearchTrial> trials;
  for (const Row& row : rows) {
    assess::SearchTrial trial;
    trial.trial = static_cast<int>(trials.size()) + 1;
    trial.role = training::Role::scored;  // the table has no others
    trial.outcome = training::outcomeNamed(row.at("OUTCOME"));
    trial.mode = row.at("MODE") == "real"       ? assess::SearchMode::real
                 : row.at("MODE") == "degraded" ? assess::SearchMode::degraded
                                                : assess::SearchMode::augmented;
    trial.target = std::stoi(row.at("TARGET"));
    trial.chosen = std::stoi(row.at("CHOSEN"));
    trials.push_back(trial);
  }
  return trials;
}

double foundShare(const std::vector<Row>& rows, const std::string& mode) {
  double found = 0, all = 0;
  for (const Row& row : rows) {
    if (row.at("MODE") != mode) continue;
    found += std::stod(row.at("FOUND"));
    ++all;
  }
  return found / all;
}

/// The searchers' figures and the task's were fixed before these episodes were ever searched (seeds
/// 20001 to 60099 served to choose them, 910001 to 910100 to find an error).
TEST(Search, ADegradedFloorLosesTheTargetAndCuesGiveItBack) {
  const Folder here;
  const int trials = test::counted(4, 100);
  const std::string seed = test::counted("930013", "920001");  // of a few, ones that tell
  const std::vector<Row> rows = episodes({"--operator", "expert", "--mode", "all", "--seed", seed,
                                          "--trials", std::to_string(trials), "--out", "A"},
                                         here);
  ASSERT_EQ(rows.size(), 3 * static_cast<std::size_t>(trials));
  for (const Row& row : rows) EXPECT_EQ(row.at("SIMULATED"), "1");
  const double real = foundShare(rows, "real"), degraded = foundShare(rows, "degraded"),
               augmented = foundShare(rows, "augmented");
  EXPECT_GT(real, degraded);
  EXPECT_GT(augmented, degraded);
  const std::string page = contentOf(here / "A/report.html");
  EXPECT_TRUE(says(page, "4.8 N") && says(page, "50000 N/m"));
  if (!test::fullCounts()) return;
  const std::optional<assess::Recovery> recovery = assess::recoveryOf(episodesOf(rows), 1);
  ASSERT_TRUE(recovery);
  EXPECT_GT(recovery->low, 0) << real << " " << degraded << " " << augmented;
  RecordProperty("real_degraded_augmented", std::to_string(real) + " " + std::to_string(degraded) +
                                                " " + std::to_string(augmented));
  RecordProperty("recovered", std::to_string(recovery->share) + " (" +
                                  std::to_string(recovery->low) + ", " +
                                  std::to_string(recovery->high) + ")");
}

/// The same floors in every mode; cues are felt in one of them only. Seen again, every one of them
/// is felt and judged as it was.
TEST(Search, ModesDifferInTheFloorsStiffnessAndInCuesOnlyAndAreReplayed) {
  const Folder here;
  const std::vector<Row> rows =
      episodes({"--operator", "expert", "--mode", "all", "--seed", "20001", "--out", "A"}, here);
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    EXPECT_EQ(row.at("ORIENTATION_DEG"), rows[i - i % 3].at("ORIENTATION_DEG"));
    EXPECT_EQ(row.at("TARGET"), rows[i - i % 3].at("TARGET"));
    double added = 0;
    for (const char* part : {"SCAN", "SHAPE", "IDENTIFY"}) {
      EXPECT_GT(std::stod(row.at(std::string(part) + "_ON_S")), 0) << part;
      added += std::stod(row.at(std::string(part) + "_IMPULSE_NS"));
    }
    if (row.at("MODE") == "augmented") {
      EXPECT_GT(added, 0.1);
    } else {
      EXPECT_EQ(added, 0) << row.at("MODE");
    }
  }
  const Outcome outcome = palpa({"replay", "A/session.palpa"}, here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "The replay equals the record")) << outcome.out;
}

/// A short episode on a floor whose rises are soon told.
std::string shortTask(const Folder& here) {
  nlohmann::json task =
      nlohmann::json::parse(contentOf(std::string(PALPA_SOURCE_DIR) + "/assets/tasks/search.json"));
  task["rises"]["map_px"]["value"] = 256;
  task["end"]["time_limit_s"]["value"] = 5;
  return here.file("short.json", task.dump());
}

/// From the export alone every force adds up, and cues and limiter come out again; and the floor is
/// drawn, on the page and by a command.
TEST(Search, TheExportAddsUpAndTheFloorIsDrawn) {
  const Folder here;
  const Outcome session = palpa(search({"--task", shortTask(here), "--operator", "expert", "--mode",
                                        "augmented", "--seed", "20001", "--out", "A"}),
                                here.path());
  ASSERT_EQ(session.exit_code, 0) << session.err;
  const Outcome drawn = palpa({"replay", "A/session.palpa", "--figures", "figures"}, here.path());
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  for (const char* file :
       {"stimulus", "texture-target", "texture-distractor", "floor", "filter", "response", "way"}) {
    const std::string svg = contentOf(here / ("figures/" + std::string(file) + ".svg"));
    EXPECT_TRUE(says(svg, "x, U") && says(svg, "data:image/png;base64,")) << file;
  }
  EXPECT_TRUE(says(contentOf(here / "figures/way.svg"), "cue: valley"));
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "stimulus, texture and response"));
  ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "ticks.csv"}, here.path()).exit_code, 0);
  EXPECT_TRUE(says(contentOf(here / "ticks.columns.txt"), "f_cue_2_D_x_N: added: the cue valley"));
  if (!pythonIsThere()) GTEST_SKIP() << "no Python (Debian: python3)";
  const ScriptVerdict verdict = checkedBy("check_ticks.py", here, 7000);
  EXPECT_GT(verdict.ticks, 4000);
  EXPECT_LT(verdict.worst_mN, 1) << verdict.said;
}

TEST(Search, TheSameSeedGivesTheSameNumbersAndViewsChangeNone) {
  const Folder here;
  ASSERT_EQ(palpa(search({"--operator", "expert", "--mode", "real", "--seed", "5", "--out", "A"}),
                  here.path())
                .exit_code,
            0);
  ASSERT_EQ(palpa({"search", "--fast", "--quiet", "--operator", "expert", "--mode", "real",
                   "--seed", "5", "--out", "B"},
                  here.path())
                .exit_code,
            0);
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(here / "B/trials.csv"));
  const std::string page = contentOf(here / "B/report.html");
  for (const char* words :
       {"SIMULATED", "Was the target found?", "The parts of the task, and what the cues added",
        "Where this task stands"})
    EXPECT_TRUE(says(page, words)) << words;
}

/// Baseline, training, evaluation: the task's blocks; here a task with short ones.
TEST(Search, BlocksComeInTheirOrderAndTrainInTheModeGiven) {
  const Folder here;
  nlohmann::json task =
      nlohmann::json::parse(contentOf(std::string(PALPA_SOURCE_DIR) + "/assets/tasks/search.json"));
  for (nlohmann::json& block : task["blocks"]) block["episodes"] = 1;
  const std::string file = here.file("short.json", task.dump());
  const std::vector<Row> rows = episodes({"--task", file, "--operator", "expert", "--mode",
                                          "augmented", "--blocks", "--seed", "20001", "--out", "A"},
                                         here);
  ASSERT_EQ(rows.size(), 3u);
  const char* blocks[] = {"baseline", "training", "evaluation"};
  const char* modes[] = {"real", "augmented", "real"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].at("BLOCK"), blocks[i]);
    EXPECT_EQ(rows[i].at("MODE"), modes[i]);
  }
}

TEST(Search, ATaskFileIsEnough) {
  const Folder here;
  const std::string task = std::string(PALPA_SOURCE_DIR) + "/assets/tasks/search.json";
  ASSERT_EQ(
      palpa(search({"--operator", "novice", "--seed", "5", "--out", "A"}), here.path()).exit_code,
      0);
  ASSERT_EQ(palpa(quickly({"train", "--task", task, "--operator", "novice", "--seed", "5",
                           "--station", quickStation("search_bench.json"), "--out", "B"}),
                  here.path())
                .exit_code,
            0);
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(here / "B/trials.csv"));
}

TEST(Search, WrongUsageIsNamed) {
  const Folder here;
  const auto refused = [&](const std::vector<std::string>& arguments, const char* word) {
    const Outcome outcome = palpa(search(arguments), here.path());
    EXPECT_EQ(outcome.exit_code, 2) << word;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, word)) << outcome.err;
  };
  refused({"--station", std::string(PALPA_SOURCE_DIR) + "/assets/stations/virtual_bench.json",
           "--operator", "expert"},
          "\"floor\"");
  refused({"--task", std::string(PALPA_SOURCE_DIR) + "/assets/tasks/paracentesis.json",
           "--operator", "expert"},
          "engine");
  refused({"--mode", "stiff"}, "--mode");
  nlohmann::json task =
      nlohmann::json::parse(contentOf(std::string(PALPA_SOURCE_DIR) + "/assets/tasks/search.json"));
  task["stimulus"]["groove_U"]["value"] = 10;
  refused({"--task", here.file("groove.json", task.dump()), "--operator", "expert"},
          "is not a floor");
}

}  // namespace
}  // namespace palpa::cli_test
