#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/record/session_file.h"
#include "program.h"
#include "tests/support/setting.h"

/// Missing and damaged files: code 1 or 2, one line that names the file, nothing half-written.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

const fs::path kAssets = fs::path(PALPA_SOURCE_DIR) / "assets";

std::string halfOf(const std::string& bytes) { return bytes.substr(0, bytes.size() / 2); }

class BadInput : public testing::Test {
 protected:
  Folder here;

  /// A session that ends before it begins: `least` to 2 as code, `word` on the one line of standard
  /// error.
  void expectRefused(const Arguments& arguments, const std::string& word, int least = 2) {
    const std::vector<std::string> before = here.files();
    const Outcome outcome = palpa(arguments, here.path());
    EXPECT_GE(outcome.exit_code, least) << outcome.err;
    EXPECT_LE(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("palpa: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos)
        << "wanted " << word << ": " << outcome.err;
    EXPECT_EQ(here.files(), before) << "something was left behind";
  }
  void expectSessionRefused(const Arguments& more, const std::string& word, int least = 2) {
    Arguments all = session(more);
    all.insert(all.end(), {"--out", (here / "results").string()});
    expectRefused(all, word, least);
  }
};

TEST_F(BadInput, StationMissingOrDamaged) {
  expectSessionRefused({"--station", "nowhere.json"}, "nowhere.json");
  expectSessionRefused({"--station", here.path().string()}, here.path().string());
  const std::string whole = contentOf(kAssets / "stations/virtual_bench.json");
  expectSessionRefused({"--station", here.file("half.json", halfOf(whole))}, "half.json");
  expectSessionRefused({"--station", here.file("empty.json", "")}, "empty.json");
  nlohmann::json station = nlohmann::json::parse(whole);
  station["safety"]["max_force_N"] = 80;
  expectSessionRefused({"--station", here.file("strong.json", station.dump())},
                       "safety/max_force_N");
  station = nlohmann::json::parse(whole);
  station["twin"]["device"].erase("coulomb_N");  // read late: by the virtual bench
  expectSessionRefused({"--station", here.file("late.json", station.dump())},
                       "twin/device/coulomb_N");
  expectRefused({"board", "print", "--station", "nowhere.json"}, "nowhere.json");
}

TEST_F(BadInput, TaskMissingOrDamaged) {
  const Arguments train{"train",   "--operator", "expert", "--fast", "--no-views",
                        "--quiet", "--out",      "r",      "--task"};
  const auto with = [&](const std::string& task) {
    Arguments a = train;
    a.push_back(task);
    return a;
  };
  expectRefused(with("nowhere.json"), "nowhere.json");
  nlohmann::json task = nlohmann::json::parse(contentOf(kAssets / "tasks/paracentesis.json"));
  task["engine"] = "needles";
  expectRefused(with(here.file("engine.json", task.dump())), "engine");
  task["engine"] = "needle";  // its materials are beside it, and are not there
  expectRefused(with(here.file("alone.json", task.dump())), "needle.json");
}

/// Whoever knows how to hold a needle does not know how to palpate.
TEST_F(BadInput, OperatorOfAnotherTask) {
  const auto with = [](const std::string& command, const std::string& who) {
    return Arguments{command,  "--operator", (kAssets / "operators" / who).string(),
                     "--fast", "--quiet",    "--out",
                     "r"};
  };
  for (const char* command : {"palpation", "search", "squeeze", "friction", "pulse"})
    expectRefused(with(command, "expert.json"), "expert.json");
  expectRefused(with("subclavian", "palpation_expert.json"), "palpation_expert.json");
}

TEST_F(BadInput, PatientMissingOrDamaged) {
  ASSERT_EQ(palpa({"patient", "build", "--out", "whole.glb"}, here.path()).exit_code, 0);
  const std::string whole = contentOf(here / "whole.glb");
  ASSERT_GT(whole.size(), 10'000u);
  expectSessionRefused({"--patient", "nowhere.glb"}, "nowhere.glb", 1);
  expectSessionRefused({"--patient", here.file("half.glb", halfOf(whole))}, "half.glb", 1);
  expectSessionRefused({"--patient", here.file("empty.glb", "")}, "empty.glb", 1);
  expectSessionRefused({"--patient", here.file("text.glb", "not a patient")}, "text.glb", 1);
  expectRefused({"patient", "info", "half.glb"}, "half.glb", 1);
}

TEST_F(BadInput, ExpertPathMissingOrDamaged) {
  expectSessionRefused({"--expert-path", "nowhere.json"}, "nowhere.json", 1);
  const std::string whole = contentOf(kAssets / "tasks/paracentesis_expert_path.json");
  ASSERT_FALSE(whole.empty());
  expectSessionRefused({"--expert-path", here.file("half.json", halfOf(whole))}, "half.json", 1);
  expectSessionRefused({"--expert-path", here.file("other.json", "{}")}, "other.json", 1);
}

TEST_F(BadInput, SessionMissingOrDamaged) {
  ASSERT_EQ(palpa(session({"--seed", kShortTrial, "--out", "whole"}), here.path()).exit_code, 0);
  const std::string half = here.file("half.palpa", halfOf(contentOf(here / "whole/session.palpa")));
  const std::string text = here.file("text.palpa", "not a session");
  const std::string empty = here.file("empty.palpa", "");
  for (const std::string& file : {std::string("nowhere.palpa"), half, text, empty}) {
    const std::string name = fs::path(file).filename().string();
    expectRefused({"replay", file}, name, 1);
    expectRefused({"export", file, "--out", "ticks.csv"}, name, 1);
    expectRefused({"calibrate", "experts", "--from", file, "--out", "path.json"}, name, 1);
  }
  const std::string whole = (here / "whole/session.palpa").string();
  // A session whose drive refused its first ticks: not a changed one.
  record::SessionWriter(here / "none.palpa", record::SessionReader(whole).info()).close();
  expectRefused({"replay", "none.palpa"}, "none.palpa: holds no tick", 1);
  expectRefused({"calibrate", "experts", "--from", whole, "--out", "path.json"}, "20",
                1);  // too few trials
}

TEST_F(BadInput, PlacesThatCannotBeWritten) {
  const std::string in_the_way = here.file("occupied", "a file");
  expectRefused(session({"--out", in_the_way}), "occupied", 1);
  expectRefused(session({"--out", in_the_way + "/below"}), "occupied", 1);
  expectRefused(session({"--out", "/proc/palpa"}), "/proc/palpa", 1);
  expectRefused({"patient", "build", "--out", "/proc/p.glb"}, "/proc/p.glb", 1);
  expectRefused({"patient", "build", "--out", "nowhere/p.glb"}, "nowhere/p.glb", 1);
  expectRefused({"board", "print", "--out", "/proc/b.png"}, "/proc/b.png", 1);
  expectRefused({"board", "print", "--out", "board.nonsense"}, "board.nonsense", 1);
  EXPECT_EQ(contentOf(in_the_way), "a file") << "it was not touched";
}

/// A limit of the size of files ends no program: it is told, as a full disk is.
TEST_F(BadInput, FilesThatMayNotBecomeSoLarge) {
  const test::Setting limit("PALPA_TEST_FILE_LIMIT", "20000");
  const Outcome outcome = palpa({"patient", "build", "--out", "p.glb"}, here.path());
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "palpa: p.glb: cannot be written")) << outcome.err;
}

/// Before, within and after a command.
TEST_F(BadInput, VerboseStandsAnywhere) {
  for (const Arguments& words : {Arguments{"--verbose", "board", "print", "--dpi", "5"},
                                 {"board", "--verbose", "print", "--dpi", "5"},
                                 {"board", "print", "--dpi", "5", "--verbose"}})
    expectRefused(words, "--dpi needs a whole number between 72 and 1200, not '5'");
}

}  // namespace
}  // namespace palpa::cli_test
