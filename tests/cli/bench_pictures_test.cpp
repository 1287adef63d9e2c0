#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/counts.h"

/// What pictures cost and what can be read from them, measured as anyone can.
namespace palpa::cli_test {
namespace {

/// What a headset's frame costs besides its drawing, which Mesa can leave out.
TEST(BenchHeadset, DrawsNothing) {
  const Folder here;
  const Outcome outcome = palpa({"bench", "headset", "--frames", "3"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = jsonLines(outcome);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0]["metric"], "headset_cpu_ms");
  EXPECT_GT(lines[0]["value"], 0);
  EXPECT_EQ(lines[0]["params"]["drawn_by"], "NOOP");
}

/// One AR view alone says how far off the skin a needle is and how deep behind it, and it is the
/// shadow that says the first.
TEST(BenchObserver, ReadsHeightAndDepthFromPixels) {
  const Folder here;
  const std::string poses = test::fullCounts() ? "200" : "6";
  const double least = test::fullCounts() ? 0.95 : 0.6;
  const Outcome outcome = palpa({"bench", "observer", "--poses", poses}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::pair<std::string, bool>, double> value;
  for (const nlohmann::json& line : jsonLines(outcome))
    value[{line["metric"], line["params"]["shadow_and_ring"]}] = line["value"];
  EXPECT_GE(value.at({"height_told", true}), least);
  EXPECT_GE(value.at({"depth_told", true}), least);
  EXPECT_LT(value.at({"height_told", false}), 0.5);
  EXPECT_TRUE(value.contains({"depth_told", false}));
}

/// Words make way for what is worked with; and yet they are there. The smallest window comes first.
TEST(BenchHud, CoversNeitherTipNorEntryNorTool) {
  const Folder here;
  const Outcome outcome =
      palpa({"bench", "hud", "--sessions", test::fullCounts() ? "200" : "1"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, double> value;
  for (const nlohmann::json& line : jsonLines(outcome)) {
    value[line["metric"]] = line["value"];
    EXPECT_EQ(line["params"]["frames"], test::fullCounts() ? 16'000 : 80);
  }
  for (const char* never : {"hud_over_tip", "hud_over_entry", "hud_over_tool", "hud_beyond_eye"})
    EXPECT_EQ(value.at(never), 0) << never;
  EXPECT_LE(value.at("hud_tool_covered_max"), 0.05);
  EXPECT_GE(value.at("hud_words_shown"), test::fullCounts() ? 0.8 : 0.4);
}

}  // namespace
}  // namespace palpa::cli_test
