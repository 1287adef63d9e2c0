#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "csv_rows.h"
#include "program.h"

/// Cues added to the forces of needle and palpation: off by default, recorded, and no part of what
/// is scored.
namespace palpa::cli_test {
namespace {

Row only(const std::vector<std::string>& arguments, const Folder& here, const std::string& out) {
  std::vector<std::string> all = arguments;
  for (const std::string& word :
       {std::string("--operator"), std::string("expert"), std::string("--seed"), std::string("3"),
        std::string("--out"), out})
    all.push_back(word);
  const Outcome outcome = palpa(quickly(all), here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<Row> rows =
      outcome.exit_code == 0 ? rowsOf(contentOf(here / (out + "/trials.csv"))) : std::vector<Row>{};
  EXPECT_EQ(rows.size(), 1u);
  return rows.empty() ? Row{} : rows.front();
}

double added(const Row& row) {
  double all = 0;
  for (const auto& [column, value] : row)
    if (says(column, "_IMPULSE_NS")) all += std::stod(value);
  return all;
}

/// A task without parts, otherwise the same.
std::string withoutParts(const std::string& name, const Folder& here) {
  const std::filesystem::path assets = std::filesystem::path(PALPA_SOURCE_DIR) / "assets";
  nlohmann::json task = nlohmann::json::parse(contentOf(assets / "tasks" / name));
  for (const char* field : {"subtasks", "augmentations", "hysteresis", "limit_share"})
    task.erase(field);
  for (const char* field : {"materials", "expert_path", "lumps"})
    if (task.contains(field))
      task[field] =
          std::filesystem::weakly_canonical(assets / "tasks" / task[field].get<std::string>())
              .string();
  return here.file(name, task.dump());
}

/// The needle as a task file among others, a palpation as its own command.
std::vector<std::string> ofTask(const std::string& file) {
  if (!says(file, "paracentesis")) return {"palpation", "--task", file};
  return {"train", "--task", file, "--station", quickStation("virtual_bench.json")};
}

std::string shipped(const std::string& task) {
  return std::string(PALPA_SOURCE_DIR) + "/assets/tasks/" + task;
}

/// Off, the parts are told and nothing is added: all else is as in a task that has none, to the
/// last digit.
void offIsAsIfTheyWereNot(const std::string& task) {
  const Folder here;
  const Row off = only(ofTask(shipped(task)), here, "off"),
            bare = only(ofTask(withoutParts(task, here)), here, "bare");
  EXPECT_EQ(off.at("AUGMENTED"), "0");
  EXPECT_EQ(added(off), 0);
  EXPECT_FALSE(bare.empty());
  for (const auto& [column, value] : bare) EXPECT_EQ(off.at(column), value) << column;
  EXPECT_GT(off.size(), bare.size());
}

void onIsFeltAndRepeats(const std::string& task, const Folder& here) {
  std::vector<std::string> arguments = ofTask(shipped(task));
  arguments.insert(arguments.end(), {"--augment", "on"});
  const Row on = only(arguments, here, "on");
  EXPECT_EQ(on.at("AUGMENTED"), "1");
  EXPECT_GT(added(on), 0.05);
  EXPECT_TRUE(
      says(contentOf(here / "on/report.html"), "In 1 of 1 trial cues were added to the forces"));
  const Outcome replay = palpa({"replay", "on/session.palpa"}, here.path());
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_TRUE(says(replay.out, "The replay equals the record")) << replay.out;
}

TEST(Augment, OffTheNeedleFeelsAsEver) { offIsAsIfTheyWereNot("paracentesis.json"); }
TEST(Augment, OnTheNeedleFeelsMore) {
  const Folder here;
  onIsFeltAndRepeats("paracentesis.json", here);
}
TEST(Augment, OffAPalpationFeelsAsEver) { offIsAsIfTheyWereNot("palpation_prostate.json"); }

TEST(Augment, OnAPalpationFeelsMoreAndCountsForNoStandard) {
  const Folder here;
  onIsFeltAndRepeats("palpation_prostate.json", here);
  EXPECT_TRUE(says(contentOf(here / "on/report.html"), "Not counted"))
      << "with cues more is felt than the tissue's own";
}

}  // namespace
}  // namespace palpa::cli_test
