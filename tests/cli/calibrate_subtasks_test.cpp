#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.h"

/// A task's parts proposed from sessions that the program itself has recorded, as an educator has
/// them proposed.
namespace palpa::cli_test {
namespace {

using nlohmann::json;

/// An expert's searches, two that are alike enough to learn from; recorded in `out`.
Outcome recordedSearch(const std::string& trials, const std::string& out, const Folder& here,
                       const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"search", "--operator", "expert", "--mode", "real", "--trials",
                                     trials,   "--seed",     "70007",  "--out",  out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return palpa(quickly(arguments), here.path());
}

/// What is proposed of two searches, in words and as a file, and that it is the same again.
void expectProposed(const Folder& here) {
  const auto proposed = [&](const std::string& out) {
    return palpa({"calibrate", "subtasks", "search/session.palpa", "--states", "4", "--seed", "3",
                  "--quiet", "--out", out},
                 here.path());
  };
  const Outcome outcome = proposed("parts");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.errLines(), 0) << outcome.err;
  for (const char* words : {"(SIMULATED)", ": 4 states.", "State 1", "kappa",
                            "The hand-written parts change", "Neither segmentation is the truth"})
    EXPECT_TRUE(says(outcome.out, words)) << words << "\n" << outcome.out;
  const std::string page = contentOf(here / "parts/calibration.html");
  for (const char* words :
       {"SIMULATED", "How many states?", "Cohen&#39;s kappa", "state 4", "identify", "trial 2"})
    EXPECT_TRUE(says(page, words)) << words;
  for (const char* words : {"src=\"http", "href=\"http", "<script", "url("})
    EXPECT_FALSE(says(page, words)) << words;  // one file
  const json file = json::parse(contentOf(here / "parts/calibration.json"));
  EXPECT_EQ(file["kind"], "subtasks");
  EXPECT_EQ(file["simulated"], true);
  EXPECT_EQ(file["parameters"]["states"][0], 4);
  ASSERT_EQ(proposed("again").exit_code, 0);
  EXPECT_EQ(json::parse(contentOf(here / "again/calibration.json"))["parameters"],
            file["parameters"]);
}

TEST(CalibrateSubtasks, FromARecordedSearchAndATaskMayAskForThem) {
  const Folder here;
  ASSERT_EQ(recordedSearch("2", "search", here).exit_code, 0);
  ASSERT_NO_FATAL_FAILURE(expectProposed(here));
  json task =
      json::parse(contentOf(std::filesystem::path(PALPA_SOURCE_DIR) / "assets/tasks/search.json"));
  task["learned"] = "parts/calibration.json";
  for (int state : {1, 2, 3, 4})
    task["subtasks"].push_back({{"name", "learned " + std::to_string(state)},
                                {"means", "as learned"},
                                {"on", {{{"cue", "learned"}, {"is", state}}}}});
  here.file("task.json", task.dump());
  const Outcome learned = recordedSearch("1", "learned", here, {"--task", "task.json"});
  ASSERT_EQ(learned.exit_code, 0) << learned.err;
  EXPECT_TRUE(says(contentOf(here / "learned/report.html"), "learned 2"));
  std::filesystem::remove_all(here / "parts");  // the recording has the model itself
  const Outcome again = palpa({"replay", "learned/session.palpa"}, here.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(says(again.out, "equals the record")) << again.out;
  const Outcome gone = recordedSearch("1", "gone", here, {"--task", "task.json"});
  EXPECT_NE(gone.exit_code, 0);
  EXPECT_TRUE(says(gone.err, "parts/calibration.json")) << gone.err;
}

TEST(CalibrateSubtasks, ProposesProceduresWithTheirCuesByTheLibrary) {
  const Folder here;
  ASSERT_EQ(recordedSearch("1", "search", here).exit_code, 0);
  const Outcome outcome =
      palpa({"calibrate", "subtasks", "search/session.palpa", "--out", "parts"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words : {"(SIMULATED)", "scrub", "cue: relief", "Kappa", "Recall: "})
    EXPECT_TRUE(says(outcome.out, words)) << words << "\n" << outcome.out;
  const json file = json::parse(contentOf(here / "parts/procedures.json"));
  ASSERT_EQ(file["trials"].size(), 1u);
  double end_s = 0;
  for (const json& part : file["trials"][0]["parts"]) {  // end to end, each with a cue
    EXPECT_NEAR(part["from_s"].get<double>(), end_s, 1e-9);
    end_s = part["to_s"].get<double>();
    EXPECT_TRUE(part["cue"].is_string());
  }
  EXPECT_NEAR(end_s, file["agreement"]["all_s"].get<double>(), 1e-6);
  const std::string page = contentOf(here / "parts/procedures.html");
  for (const char* words : {"SIMULATED", "cue proposed", "scrub", "recall"})
    EXPECT_TRUE(says(page, words)) << words;
  for (const char* words : {"src=\"http", "href=\"http", "<script", "url("})
    EXPECT_FALSE(says(page, words)) << words;
}

TEST(CalibrateSubtasks, RefusesWhatHasNoPartsOrTooFewTrials) {
  const Folder here;
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words,
                           int exit_code = 1) {
    std::vector<std::string> arguments{"calibrate", "subtasks", "--out", "parts", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = palpa(arguments, here.path());
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, words)) << outcome.err;
  };
  here.file("text.palpa", "a text that is long enough to be looked at");
  refused({"text.palpa"}, "text.palpa: is not a session file");
  refused({"none.palpa"}, "none.palpa: no such file");
  ASSERT_EQ(recordedSearch("1", "one", here).exit_code, 0);
  refused({"one/session.palpa", "--learn"}, "1 trial is too few");
  refused({"one/session.palpa", "--learn", "--library", "own.json"}, "--library", 2);
  here.file("task.json", "{}");
  refused({"one/session.palpa", "--task", "task.json"}, "--task", 2);
  ASSERT_EQ(palpa(quickly({"squeeze", "--operator", "expert", "--trials", "1", "--seed", "70001",
                           "--out", "squeeze"}),
                  here.path())
                .exit_code,
            0);
  refused({"squeeze/session.palpa"}, "names no parts (\"subtasks\")");
  EXPECT_FALSE(std::filesystem::exists(here / "parts"));
}

}  // namespace
}  // namespace palpa::cli_test
