#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "csv_rows.h"
#include "program.h"

/// A task with a goal of its own that is made of files alone: a block of bone, from cortical to
/// cancellous.
namespace palpa::cli_test {
namespace {

const std::string kBonePin = std::string(PALPA_SOURCE_DIR) + "/assets/tasks/bone_pin.json";

std::vector<Row> pinned(const Folder& here, const std::string& out,
                        const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"train",      "--task",  kBonePin,   "--operator", "expert",
                                     "--seed",     "31001",   "--trials", "3",          "--fast",
                                     "--no-views", "--quiet", "--out",    out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = palpa(arguments, here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? rowsOf(contentOf(here / (out + "/trials.csv")))
                                : std::vector<Row>{};
}

TEST(BonePin, CorticalGivesWayToCancellous) {
  const Folder here;
  for (const Row& row : pinned(here, "off", {})) {
    EXPECT_EQ(row.at("SUCCESS"), "1");
    EXPECT_EQ(row.at("AUGMENTED"), "0");
    EXPECT_EQ(row.at("TOTAL"), "");  // no path, no penalties
    EXPECT_GT(std::stod(row.at("CORTEX_ON_S")), 0.1);
    EXPECT_GE(std::stod(row.at("SEATED_ON_S")), 1);
    EXPECT_EQ(row.at("TOO_DEEP_TIMES"), "0");
    EXPECT_EQ(row.at("CANCELLOUS_IMPULSE_NS"), "0");
  }
  const std::string page = contentOf(here / "off/report.html");
  for (const char* words : {"Insertion of a bone pin", "the pin is seated in cancellous bone",
                            "cortex", "Through the surface of the bone"})
    EXPECT_TRUE(says(page, words)) << words;
  for (const char* words : {"Vein", "vein", "pleura", "Total penalty", "Redirections", "clavicle"})
    EXPECT_FALSE(says(page, words)) << words;
  const Outcome replay = palpa({"replay", "off/session.palpa"}, here.path());
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_TRUE(says(replay.out, "equals the record") && says(replay.out, "Done after"))
      << replay.out;
}

/// The one event that the cue is for: a pulse of 1.2 N for 20 ms, as often as cancellous bone is
/// entered.
TEST(BonePin, TheCueIsGivenAtTheTransition) {
  const Folder here;
  const std::vector<Row> rows = pinned(here, "on", {"--augment", "on"});
  ASSERT_EQ(rows.size(), 3u);
  for (const Row& row : rows) {
    const double times = std::stod(row.at("CANCELLOUS_TIMES"));
    EXPECT_GE(times, 1);
    EXPECT_NEAR(std::stod(row.at("CANCELLOUS_IMPULSE_NS")), 0.024 * times, 0.0013 * times);
    EXPECT_EQ(row.at("TOO_DEEP_IMPULSE_NS"), "0");
  }
}

TEST(BonePin, ABlockIsNoPatient) {
  const Folder here;
  here.file("path.json", "{}");
  for (const std::vector<std::string>& option : {std::vector<std::string>{"--patient-seed", "3"},
                                                 {"--guide", "on"},
                                                 {"--expert-path", "path.json"}}) {
    std::vector<std::string> arguments{"train",  "--task",     kBonePin, "--operator", "expert",
                                       "--fast", "--no-views", "--out",  "refused"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    const Outcome outcome = palpa(arguments, here.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(says(outcome.err, option.front() + ": has no meaning for this task"))
        << outcome.err;
  }
}

}  // namespace
}  // namespace palpa::cli_test
