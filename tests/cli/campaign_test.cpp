#include <gtest/gtest.h>

#include <sstream>

#include "program.h"

/// What `palpa campaign` prints and refuses; that nothing is computed twice or lost is tested by
/// tests/study_run, and through Slurm by slurm.sh.
namespace palpa::cli_test {
namespace {

const std::string kAssets = std::string(PALPA_SOURCE_DIR) + "/assets";

std::string campaignIn(const Folder& here, int seeds) {
  return here.file("it's.json", R"({"version": 1, "id": "small", "title": "Small",
    "tasks": [")" + kAssets + R"(/tasks/squeeze.json"], "station": ")" +
                                    quickStation("palpation_bench.json") + R"(",
    "operators": ["expert"], "seeds": {"from": 1, "count": )" +
                                    std::to_string(seeds) + "}}");
}

TEST(Campaign, RunsOnceAndSaysWhatIsThere) {
  const Folder here;
  const std::string file = campaignIn(here, 1);
  const Outcome before = palpa({"campaign", file, "--status"}, here.path());
  EXPECT_EQ(before.exit_code, 0) << before.err;
  EXPECT_TRUE(says(before.out, "Small: 1 session of 1 trial each\n0 done, 1 to compute"))
      << before.out;
  const Outcome run = palpa({"campaign", file}, here.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(says(run.out, "1 session, 1 computed now")) << run.out;
  EXPECT_TRUE(says(run.out, "Written: out/campaign-small/trials.csv: 1 trial of 1 session"))
      << run.out;
  const Outcome again = palpa({"campaign", file, "--quiet"}, here.path());
  EXPECT_TRUE(says(again.out, "1 session, 0 computed now")) << again.out;
  EXPECT_TRUE(says(palpa({"campaign", file, "--status"}, here.path()).out, "1 done, 0 to compute"));
  const Outcome more = palpa({"campaign", campaignIn(here, 2), "--collect"}, here.path());
  EXPECT_EQ(more.exit_code, 1);
  EXPECT_TRUE(says(more.err, "1 of 2 sessions missing in the table")) << more.err;
  EXPECT_EQ(more.errLines(), 1);
  EXPECT_EQ(palpa({"finish"}, here.path()).out, "Every session noted here was finished\n");
}

TEST(Campaign, PrintsCommandsThatAShellReads) {
  const Folder here;
  const std::string file = campaignIn(here, 5);
  const Outcome list =
      palpa({"campaign", file, "--out", "a b", "--list-commands", "3"}, here.path());
  ASSERT_EQ(list.exit_code, 0) << list.err;
  std::istringstream lines(list.out);
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(says(line, "/it'\\''s.json' --out '")) << line;
    EXPECT_TRUE(line.ends_with("--part " + std::to_string(++count) + "/3")) << line;
  }
  EXPECT_EQ(count, 3);
  const Outcome script = palpa({"campaign", file, "--slurm"}, here.path());
  ASSERT_EQ(script.exit_code, 0) << script.err;
  EXPECT_EQ(script.out.find("#!/bin/sh\n"), 0u);
  EXPECT_TRUE(says(script.out, "\n#SBATCH --array=1-5\n")) << script.out;
  EXPECT_TRUE(says(script.out, "--part \"$SLURM_ARRAY_TASK_ID/5\""));
}

TEST(Campaign, RefusesWhatMakesNoSense) {
  const Folder here;
  const std::string file = campaignIn(here, 1);
  const std::pair<std::vector<std::string>, const char*> cases[]{
      {{"--part", "4/3"}, "--part needs a part and how many there are, such as 2/7, not"},
      {{"--part", "one"}, "--part needs a part"},
      {{"--status", "--collect"}, "do not go together"},
      {{"--records", "r.sqlite", "--keep", "table"}, "need the evidence"},
      {{"--records", "r.sqlite", "--part", "1/2"}, "are for the whole"},
      {{"--records", "mysql://a/b"}, "mysql"},
      {{"--keep", "all"}, "--keep needs"}};
  for (const auto& [words, said] : cases) {
    std::vector<std::string> all{"campaign", file};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome refused = palpa(all, here.path());
    EXPECT_EQ(refused.exit_code, 2) << said;
    EXPECT_TRUE(says(refused.err, said)) << refused.err;
    EXPECT_EQ(refused.errLines(), 1) << refused.err;
  }
  EXPECT_TRUE(here.files().size() == 1) << "nothing was made";
}

}  // namespace
}  // namespace palpa::cli_test
