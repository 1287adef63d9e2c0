#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/counts.h"

/// Simulated examiners who want to pass without finding lumps, and one who finds them: sets of
/// eight cases each.
namespace palpa::cli_test {
namespace {

/// The shipped expert but for these figures.
void writeExaminer(const std::filesystem::path& file, const nlohmann::json& changes) {
  nlohmann::json examiner = nlohmann::json::parse(contentOf(
      std::filesystem::path(PALPA_SOURCE_DIR) / "assets/operators/palpation_expert.json"));
  for (const auto& [field, value] : changes.items()) {
    if (value.is_array())
      examiner[field] = value;
    else
      examiner[field]["value"] = value;
  }
  std::ofstream(file) << examiner;
}

/// "yes", "no: too many false alarms", "not judged".
std::string verdictIn(const std::string& page) {
  const std::size_t row = page.find("Passed?");
  if (row == std::string::npos) return "";
  const std::size_t at = page.find("<td", row), from = page.find('>', at) + 1;
  return page.substr(from, page.find('<', from) - from);
}

/// Verdicts over so many sets.
std::vector<std::string> examined(const std::string& examiner, int sets, const Folder& here) {
  // In a short check a quarter of the shipped area, with one lump of two kinds at most.
  const nlohmann::json small{{"area", {{"half_across_mm", 15}, {"half_away_mm", 15}}},
                             {"cases", {{"lumps", {0.25, 0.75}}, {"kinds", {"large", "hard"}}}}};
  const std::string task =
      taskWith("palpation_breast", test::fullCounts() ? nlohmann::json::object() : small, here);
  std::vector<std::string> verdicts;
  for (int set = 0; set < sets; ++set) {
    const std::string out = "set" + std::to_string(set), seed = std::to_string(30001 + 8 * set);
    const Outcome outcome = palpa(quickly({"palpation", "--task", task, "--operator", examiner,
                                           "--trials", "8", "--seed", seed, "--out", out}),
                                  here.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    if (outcome.exit_code != 0) break;
    verdicts.push_back(verdictIn(contentOf(here / (out + "/report.html"))));
  }
  return verdicts;
}

struct Cheat {
  const char* name;
  nlohmann::json changes;
  const char* why;  ///< among the reasons of the verdict
};

const nlohmann::json kMarksAll{{"looks_closer", -2}, {"marks_from", -2}, {"again", 0},
                               {"rounds", 0},        {"confirms", 0},    {"feels_around", 0},
                               {"knows_anatomy", 0}};

nlohmann::json with(nlohmann::json changes, const nlohmann::json& more) {
  changes.update(more);
  return changes;
}

class Cheating : public testing::TestWithParam<Cheat> {};

TEST_P(Cheating, DoesNotPass) {
  const std::string name = GetParam().name;
  if (!test::fullCounts() && (name == "PressesOnlyLightly" || name == "MarksEverything"))
    GTEST_SKIP() << "much like another: with every stated count";
  const Folder here;
  writeExaminer(here / "examiner.json", GetParam().changes);
  const int sets = test::counted(1, 25);
  const auto verdicts = examined((here / "examiner.json").string(), sets, here);
  ASSERT_EQ(verdicts.size(), static_cast<std::size_t>(sets));
  for (const std::string& verdict : verdicts) {
    EXPECT_EQ(verdict.rfind("no: ", 0), 0u) << verdict;
    EXPECT_TRUE(says(verdict, GetParam().why)) << verdict;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Examiner, Cheating,
    testing::Values(
        Cheat{"PressesAGridLightly",
              with(kMarksAll, {{"pressures_N", nlohmann::json::array({0.16})},
                               {"looks_closer", 0},
                               {"marks_from", 0}}),
              "too little felt deeply"},
        Cheat{"MarksEverything", kMarksAll, "too many false alarms"},
        Cheat{"MarksNothing", {{"looks_closer", 2}, {"marks_from", 2}}, "too few lumps found"},
        Cheat{"PressesOnlyLightly",
              {{"pressures_N", nlohmann::json::array({0.16})}},
              "too little felt deeply"},
        Cheat{"SearchesOnlyHalf", {{"area_share", 0.5}}, "too little of the area felt"}),
    [](const auto& of) { return of.param.name; });

TEST(Examiner, WhoFindsThemPasses) {
  const Folder here;
  const int sets = test::counted(1, 25);
  const auto verdicts = examined("expert", sets, here);
  EXPECT_GE(10 * std::count(verdicts.begin(), verdicts.end(), "yes"), 9 * sets);
}

}  // namespace
}  // namespace palpa::cli_test
