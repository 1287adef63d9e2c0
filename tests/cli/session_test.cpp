#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "csv_rows.h"
#include "program.h"
#include "tests/support/setting.h"

/// Whole sessions of a simulated expert, from the arguments to the files. Each takes a few seconds.
namespace palpa::cli_test {
namespace {

/// One session a program run, shared by the tests that only look at it.
struct Recorded {
  Folder here;
  Outcome outcome;
  explicit Recorded(std::vector<std::string> more) {
    more.insert(more.end(), {"--out", "A"});
    outcome = palpa(session(more), here.path());
  }
  std::string csv() const { return contentOf(here / "A/trials.csv"); }
  std::string report() const { return contentOf(here / "A/report.html"); }
};

Recorded& first() {
  static Recorded recorded({"--seed", kShortTrial, "--trainee", "T042"});
  return recorded;
}

void expectTable(const std::string& csv) {
  const std::vector<Row> rows = rowsOf(csv);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("SIMULATED"), "1");
  EXPECT_EQ(rows[0].at("TRIAL"), "1");
  EXPECT_EQ(rows[0].at("SEED"), "1");
  EXPECT_GT(std::stod(rows[0].at("TOTAL")), 0);
  for (const char* column : {"COL_LUNG", "COL_RIB", "COL_ART", "COL_VEIN", "PHASE_1", "PHASE_2",
                             "ECON_MEAN", "ECON_VAR", "TIME"})
    EXPECT_TRUE(rows[0].count(column)) << column;
}

void expectPage(const std::string& page) {
  EXPECT_TRUE(says(page, "simulated") || says(page, "SIMULATED"));
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "url(http"})
    EXPECT_FALSE(says(page, outside)) << outside << ": no network is needed";
  EXPECT_TRUE(says(page, "</html>"));
}

/// Shipped station and patient, every option as it is by itself.
TEST(Session, LeavesItsFilesWhichCallItSimulatedAndSaysSo) {
  const Folder here;
  const Outcome outcome =
      palpa({"subclavian", "--operator", "expert", "--fast", "--no-views", "--quiet", "--out", "A"},
            here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "--quiet";
  EXPECT_EQ(here.files(),
            (std::vector<std::string>{"A/report.html", "A/session.palpa", "A/trials.csv"}))
      << "no partial and no temporary file";
  for (const char* file : {"report.html", "trials.csv", "session.palpa"})
    EXPECT_TRUE(says(outcome.out, file)) << file;
  expectTable(contentOf(here / "A/trials.csv"));
  expectPage(contentOf(here / "A/report.html"));
}

TEST(Session, SkinThatIsShownToGiveWayChangesNoScore) {
  const Recorded shown({"--seed", kShortTrial, "--trainee", "T042", "--skin-deflection", "on"});
  ASSERT_EQ(shown.outcome.exit_code, 0) << shown.outcome.err;
  EXPECT_EQ(shown.csv(), first().csv());
}

TEST(Session, SameSeedGivesTheSameTableAndTheSameTicks) {
  const Recorded again({"--seed", kShortTrial, "--trainee", "T042"});
  ASSERT_EQ(again.outcome.exit_code, 0) << again.outcome.err;
  EXPECT_EQ(again.csv(), first().csv());
  for (const Folder* here : {&again.here, &std::as_const(first().here)})
    ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "ticks.csv"}, here->path()).exit_code,
              0);
  const std::string ticks = contentOf(first().here / "ticks.csv");
  EXPECT_GT(std::count(ticks.begin(), ticks.end(), '\n'), 5000) << "more than 5 s at 1 kHz";
  EXPECT_TRUE(contentOf(again.here / "ticks.csv") == ticks) << "the ticks differ";
  for (const Folder* here : {&again.here, &std::as_const(first().here)})
    for (const std::string& file : here->files())
      if (file.rfind("ticks", 0) == 0) std::filesystem::remove(*here / file);
}

TEST(Session, ReplayEqualsTheRecord) {
  const Outcome replay = palpa({"replay", "A/session.palpa"}, first().here.path());
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_NE(replay.out.find(": 0 differ"), std::string::npos) << replay.out;
  EXPECT_NE(replay.out.find("same score"), std::string::npos) << replay.out;
}

TEST(Session, NothingIsWrittenOnlyToBeReadAgain) {
  const test::Setting nowhere("PALPA_TEST_TMPDIR", "/nowhere");
  const Recorded again({"--seed", kShortTrial, "--trainee", "T042"});
  ASSERT_EQ(again.outcome.exit_code, 0) << again.outcome.err;
  EXPECT_EQ(again.csv(), first().csv());
  const Outcome replay = palpa({"replay", "A/session.palpa"}, again.here.path()),
                page = palpa({"report", "trial", "A", "--out", "page.html"}, again.here.path());
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_NE(replay.out.find("same score"), std::string::npos) << replay.out;
  EXPECT_EQ(page.exit_code, 0) << page.err;
}

TEST(Session, ViewsChangeNoScore) {
  const Folder here;
  const Outcome outcome = palpa({"subclavian", "--operator", "expert", "--fast", "--quiet",
                                 "--seed", kShortTrial, "--trainee", "T042", "--out", "A"},
                                here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(contentOf(here / "A/trials.csv"), first().csv());
  const std::vector<std::string> files = here.files();
  EXPECT_TRUE(std::any_of(files.begin(), files.end(), [](const auto& f) {
    return f.rfind("A/view-", 0) == 0;
  })) << "pictures of the marked moments";
}

TEST(Session, AnotherSeedTheLeftSideAndNoForceFeedbackWork) {
  const Recorded other(
      {"--seed", "40", "--side", "left", "--handedness", "left", "--force-feedback", "off"});
  ASSERT_EQ(other.outcome.exit_code, 0) << other.outcome.err;
  const std::vector<Row> rows = rowsOf(other.csv());
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("SEED"), "40");
  EXPECT_EQ(rows[0].at("SIMULATED"), "1");
  EXPECT_NE(other.csv(), first().csv());
  EXPECT_NE(other.report().find("left side"), std::string::npos);
  EXPECT_EQ(palpa({"replay", "A/session.palpa"}, other.here.path()).exit_code, 0);
}

TEST(Session, TaskFileAndSavedPatientGiveWhatTheShippedOnesGive) {
  const Folder here;
  ASSERT_EQ(palpa({"patient", "build", "--out", "p.glb"}, here.path()).exit_code, 0);
  const Outcome outcome = palpa(
      quickly({"train", "--task", std::string(PALPA_SOURCE_DIR) + "/assets/tasks/paracentesis.json",
               "--operator", "expert", "--station", quickStation("virtual_bench.json"), "--patient",
               "p.glb", "--seed", "13", "--out", "A"}),
      here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<Row> rows = rowsOf(contentOf(here / "A/trials.csv"));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("SEED"), "13");
  EXPECT_EQ(palpa({"replay", "A/session.palpa"}, here.path()).exit_code, 0);
}

TEST(Session, ChangedRecordIsNotReplayedAsTrue) {
  const std::string whole = contentOf(first().here / "A/session.palpa");
  ASSERT_GT(whole.size(), 100'000u);
  const Folder here;
  int told = 0;
  for (int part = 1; part < 8; ++part) {  // one byte in each eighth
    std::string changed = whole;
    changed[whole.size() / 8 * static_cast<std::size_t>(part) + 1000] ^= 0x55;
    const Outcome replay = palpa({"replay", here.file("changed.palpa", changed)}, here.path());
    EXPECT_TRUE(replay.exit_code == 0 || replay.exit_code == 1 || replay.exit_code == 2)
        << replay.exit_code;
    EXPECT_EQ(replay.errLines(), replay.exit_code == 0 ? 0 : 1) << replay.err;
    told += replay.exit_code != 0;
  }
  EXPECT_GE(told, 4) << "free pages apart, a flipped byte is noticed";
}

}  // namespace
}  // namespace palpa::cli_test
