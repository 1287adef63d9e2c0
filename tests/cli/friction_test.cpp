#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "csv_rows.h"
#include "guide_script.h"
#include "program.h"
#include "tests/support/counts.h"

/// Surfaces compared by stroking, as an educator runs it.
namespace palpa::cli_test {
namespace {

Outcome friction(std::vector<std::string> more, const Folder& here) {
  more.insert(more.begin(), "friction");
  return palpa(quickly(more), here.path());
}

int rightAnswers(const std::vector<Row>& rows) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(),
                                        [](const Row& row) { return row.at("RIGHT") == "1"; }));
}

std::vector<Row> stroked(const std::string& who, int trials, const Folder& here,
                         std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"--operator", who, "--seed", "1", "--trials", std::to_string(trials), "--out", who});
  const Outcome outcome = friction(more, here);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? rowsOf(contentOf(here / (who + "/trials.csv")))
                                : std::vector<Row>{};
}

/// By their Weber fractions experts are right in 98 %, novices in 80 % of these comparisons; of 64
/// answers that is 63 +- 2 and 51 +- 6 (two standard deviations).
TEST(Friction, ExpertsTellSurfacesApartAndNovicesLessWell) {
  const Folder here;
  const int trials = test::counted(6, 64);
  const std::vector<Row> expert = stroked("expert", trials, here),
                         novice = stroked("novice", trials, here);
  ASSERT_EQ(expert.size(), static_cast<std::size_t>(trials));
  EXPECT_GE(rightAnswers(expert), 0.8 * trials);
  EXPECT_GE(rightAnswers(novice), 0.5 * trials);
  if (test::fullCounts()) {
    EXPECT_LE(rightAnswers(novice), rightAnswers(expert) - 0.08 * trials);
  }
  for (const Row& row : expert) {
    EXPECT_EQ(row.at("SIMULATED"), "1");
    EXPECT_EQ(row.at("OUTCOME"), "done");
    EXPECT_EQ(row.at("PROPERTY"), "friction");
    EXPECT_GE(std::stoi(row.at("TOUCHES_FIRST")), 1);
    EXPECT_GE(std::stoi(row.at("TOUCHES_SECOND")), 1);
    EXPECT_LT(std::stod(row.at("PEAK_N")), 2);
  }
}

TEST(Friction, SeveralSurfacesArePutInOrder) {
  const Folder here;
  const int trials = test::counted(2, 16);
  const std::vector<Row> rows = stroked("expert", trials, here, {"--sort"});
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(trials));
  double tau = 0;
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("OUTCOME"), "done");
    EXPECT_EQ(row.at("ORDER").size(), 7u) << "four numbers: " << row.at("ORDER");
    EXPECT_EQ(row.at("RIGHT") == "1", row.at("ORDER") == row.at("TRUE_ORDER"));
    tau += std::stod(row.at("TAU"));
  }
  EXPECT_GE(tau / trials, 0.6) << "of factors 1.4 apart an expert confuses neighbours at most";
  EXPECT_TRUE(says(contentOf(here / "expert/report.html"), "From the smoothest to the roughest"));
}

/// Without force all are the same silicone: no answer is better than another.
TEST(Friction, WithoutForceFeedbackItIsGuessing) {
  const Folder here;
  if (!test::fullCounts()) GTEST_SKIP() << "of few answers nothing follows: with PALPA_FULL=1";
  constexpr int trials = 16;
  const std::vector<Row> rows = stroked("expert", trials, here, {"--force-feedback", "off"});
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(trials));
  EXPECT_GE(rightAnswers(rows), trials / 8);
  EXPECT_LE(rightAnswers(rows), trials - trials / 8);
}

TEST(Friction, ReplayJudgesItAgainAndForcesAddUp) {
  const Folder here;
  for (const std::vector<std::string>& kind :
       {std::vector<std::string>{}, std::vector<std::string>{"--sort"}}) {
    const std::string out = kind.empty() ? "A" : "B";
    std::vector<std::string> words = kind;
    words.insert(words.end(), {"--operator", "expert", "--trials", "1", "--out", out});
    ASSERT_EQ(friction(words, here).exit_code, 0);
    const Outcome outcome = palpa({"replay", out + "/session.palpa"}, here.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
    EXPECT_TRUE(says(outcome.out, ": 0 differ")) << outcome.out;
    EXPECT_TRUE(says(outcome.out, "The replay equals the record"));
    const std::string words_before = "add up to m a: within ";
    const std::size_t at = outcome.out.find(words_before);
    ASSERT_NE(at, std::string::npos) << outcome.out;
    EXPECT_LE(std::stod(outcome.out.substr(at + words_before.size())), 0.05);
  }
}

/// A task of surfaces that shake the tool as well: friction.json on a lumps' file that names a
/// texture.
std::string withTexture(const Folder& here) {
  const std::filesystem::path assets = std::filesystem::path(PALPA_SOURCE_DIR) / "assets";
  nlohmann::json lumps = nlohmann::json::parse(contentOf(assets / "materials/lumps.json"));
  const auto whole = [&](nlohmann::json& path) {
    path = (assets / "materials" / path.get<std::string>()).string();
  };
  whole(lumps["surface"]);
  whole(lumps["friction"]);
  for (nlohmann::json& kind : lumps["kinds"]) whole(kind["identified"]);
  lumps["texture"] = (assets / "materials/textures/wood.json").string();
  nlohmann::json task = nlohmann::json::parse(contentOf(assets / "tasks/friction.json"));
  task["lumps"] = here.file("rough-lumps.json", lumps.dump());
  return here.file("rough.json", task.dump());
}

/// What the hand felt of each surface, from the export alone: as much friction as was asked for.
TEST(Friction, TheExportHoldsTheFrictionThatWasAskedForAndFelt) {
  const Folder here;
  const Outcome session = friction({"--task", withTexture(here), "--sort", "--operator", "expert",
                                    "--trials", "1", "--out", "A"},
                                   here);
  ASSERT_EQ(session.exit_code, 0) << session.err;
  ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "ticks.csv"}, here.path()).exit_code, 0);
  std::map<double, std::pair<double, double>> rubbed;  // by factor: tangential, normal, N
  for (const Row& row : rowsOf(contentOf(here / "ticks.csv"))) {
    const auto number = [&](const std::string& name) { return std::stod(row.at(name)); };
    const double f_n = number("f_sensed_D_y_N");  // up, on the palpation bench
    if (row.at("armed") == "0" || f_n < 0.3) continue;
    auto& [along, normal] = rubbed[number("friction")];
    along += std::hypot(number("f_sensed_D_x_N") + number("f_command_D_x_N"),
                        number("f_sensed_D_z_N") + number("f_command_D_z_N"));
    normal += f_n;
  }
  ASSERT_EQ(rubbed.size(), 4u);
  double once = 0;
  for (const auto& [factor, sums] : rubbed) once += sums.first / sums.second / factor / 4;
  EXPECT_GT(once, 0.1);
  for (const auto& [factor, sums] : rubbed)
    EXPECT_NEAR(sums.first / sums.second, factor * once, 0.2 * factor * once) << factor;
  if (!pythonIsThere()) GTEST_SKIP() << "no Python (Debian: python3)";
  const ScriptVerdict laws = checkedBy("check_touch.py", here, 12000);
  EXPECT_GT(laws.ticks, 5000);
  EXPECT_LT(laws.worst_mN, 1);
  for (const char* what : {"stiffness", "friction", "texture"})
    EXPECT_TRUE(says(laws.said, what)) << laws.said;
}

TEST(Friction, ATaskFileIsTheSameSession) {
  const Folder here;
  ASSERT_EQ(friction({"--operator", "expert", "--trials", "1", "--seed", "3", "--out", "A"}, here)
                .exit_code,
            0);
  ASSERT_EQ(palpa({"train", "--task", std::string(PALPA_SOURCE_DIR) + "/assets/tasks/friction.json",
                   "--fast", "--quiet", "--operator", "expert", "--trials", "1", "--seed", "3",
                   "--out", "B"},
                  here.path())
                .exit_code,
            0);
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(here / "B/trials.csv"));
  const std::string page = contentOf(here / "B/report.html");
  for (const char* words :
       {"SIMULATED", "Where this task stands", "a real surface, another friction", "Every answer"})
    EXPECT_TRUE(says(page, words)) << words;
  bool pictures = false;
  for (const std::string& file : here.files()) pictures = pictures || says(file, "-stroked.png");
  EXPECT_TRUE(pictures);
}

TEST(Friction, WrongUsageIsNamed) {
  const Folder here;
  const Outcome person = friction({"--operator", "person"}, here);
  EXPECT_EQ(person.exit_code, 2);
  EXPECT_TRUE(says(person.err, "--operator")) << person.err;
  const Outcome station =
      friction({"--operator", "expert", "--station",
                std::string(PALPA_SOURCE_DIR) + "/assets/stations/virtual_bench.json"},
               here);
  EXPECT_EQ(station.exit_code, 2);
  EXPECT_TRUE(says(station.err, "sample")) << station.err;
  const Outcome other = palpa(
      quickly({"train", "--task", std::string(PALPA_SOURCE_DIR) + "/assets/tasks/squeeze.json",
               "--operator", "expert", "--sort", "--out", "C"}),
      here.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(says(other.err, "--sort")) << other.err;
  const Outcome squeeze = friction({"--operator", "expert", "--task",
                                    std::string(PALPA_SOURCE_DIR) + "/assets/tasks/squeeze.json"},
                                   here);
  EXPECT_EQ(squeeze.exit_code, 2);
  EXPECT_TRUE(says(squeeze.err, "engine")) << squeeze.err;
}

}  // namespace
}  // namespace palpa::cli_test
