#include <gtest/gtest.h>

#include <cstdlib>

#include "apps/record/store/delivery.h"
#include "apps/record/store/record_store.h"
#include "csv_rows.h"
#include "program.h"

/// The records of a centre, as an educator keeps them.
namespace palpa::cli_test {
namespace {

Outcome records(std::vector<std::string> words, const Folder& here) {
  words.insert(words.begin(), "records");
  words.insert(words.end(), {"--records", "records.sqlite"});
  return palpa(words, here.path());
}

TEST(Records, ASessionComesInOnceWithEveryFigure) {
  const Folder here;
  const Outcome added = records(
      {"trainee", "add", "--id", "T007", "--group", "novice", "--experience", "3rd year"}, here);
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_TRUE(says(added.out, "Consent to keeping training records is not noted")) << added.out;
  ASSERT_EQ(palpa(quickly({"subclavian", "--operator", "expert", "--trials", "2", "--seed", "40",
                           "--trainee", "T007", "--out", "A"}),
                  here.path())
                .exit_code,
            0);
  const Outcome first = records({"add", "A"}, here),
                again = records({"add", "A/session.palpa"}, here);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(says(first.out, "2 trials added, 0 there already")) << first.out;
  EXPECT_TRUE(says(again.out, "0 trials added, 2 there already")) << again.out;

  record::RecordStore store((here / "records.sqlite").string());
  const auto trials = store.trials();
  const std::vector<Row> rows = rowsOf(contentOf(here / "A/trials.csv"));
  ASSERT_EQ(trials.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const record::StoredTrial& t = trials[i].trial;
    EXPECT_TRUE(trials[i].session.simulated);
    EXPECT_EQ(trials[i].session.task, "paracentesis");
    EXPECT_EQ(trials[i].session.evidence_sha256.size(), 64u);
    EXPECT_EQ(std::to_string(t.seed), rows[i].at("SEED"));
    EXPECT_NEAR(t.metric("total"), std::stod(rows[i].at("TOTAL")), 0.01);
    EXPECT_EQ(t.success, rows[i].at("SUCCESS") == "1");
    EXPECT_GT(t.metric("path_length_mm"), 10);
    EXPECT_GT(t.metric("tissue_time_s"), 0);
    EXPECT_FALSE(store.events(trials[i].session.uuid, t.number).empty());
  }
}

TEST(Records, APersonIsDeletedWithTheEvidence) {
  const Folder here;
  ASSERT_EQ(
      records({"trainee", "add", "--id", "T007", "--consent", "--keep-until", "2030-01-01"}, here)
          .exit_code,
      0);
  ASSERT_EQ(palpa(session({"--seed", kShortTrial, "--trainee", "T007", "--out", "A"}), here.path())
                .exit_code,
            0);
  ASSERT_EQ(records({"add", "A"}, here).exit_code, 0);
  EXPECT_TRUE(says(records({"trainee", "list"}, here).out, "1 session"));
  const Outcome asked = records({"delete", "--id", "T007"}, here);
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_TRUE(says(asked.err, "--yes")) << asked.err;
  EXPECT_TRUE(std::filesystem::exists(here / "A/session.palpa"));
  const Outcome deleted = records({"delete", "--id", "T007", "--yes"}, here);
  EXPECT_EQ(deleted.exit_code, 0) << deleted.err;
  EXPECT_FALSE(says(deleted.out, "Still to be deleted")) << deleted.out;
  EXPECT_FALSE(std::filesystem::exists(here / "A")) << "with report, table and pictures";
  EXPECT_TRUE(says(records({"trainee", "list"}, here).out, "0 trainees"));
}

TEST(Records, WhatCannotBeSentNowIsSentLater) {
  const Folder here;
  ::setenv("XDG_STATE_HOME", here.path().c_str(), 1);
  ASSERT_EQ(palpa(session({"--seed", kShortTrial, "--trainee", "T007", "--out", "A"}), here.path())
                .exit_code,
            0);
  // A server that is not there: noted. Then the note is pointed at a file, as if the server were
  // back under that address.
  const Outcome away = palpa(
      {"records", "add", "A", "--records", "postgresql://nobody@127.0.0.1:1/palpa"}, here.path());
  EXPECT_EQ(away.exit_code, 1);
  EXPECT_TRUE(says(away.out, "palpa records deliver sends it")) << away.out;
  EXPECT_TRUE(says(away.err, "cannot be reached")) << away.err;
  const auto noted = record::PendingList(here / "palpa/pending").sessions();
  ASSERT_EQ(noted.size(), 1u);
  record::PendingList(here / "palpa/pending")
      .note({noted[0].uuid, noted[0].evidence, (here / "records.sqlite").string()});
  ASSERT_EQ(records({"trainee", "add", "--id", "T007"}, here).exit_code, 0);
  const Outcome sent = palpa({"records", "deliver"}, here.path());
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_TRUE(says(sent.out, "1 trial added")) << sent.out;
  EXPECT_TRUE(says(palpa({"records", "deliver"}, here.path()).out, "Nothing waits"));
  EXPECT_EQ(record::RecordStore((here / "records.sqlite").string()).trials().size(), 1u);
  ::unsetenv("XDG_STATE_HOME");
}

TEST(Records, AnotherSessionsEvidenceIsNotDeleted) {
  const Folder here;
  ASSERT_EQ(records({"trainee", "add", "--id", "T007"}, here).exit_code, 0);
  ASSERT_EQ(palpa(session({"--seed", kShortTrial, "--trainee", "T007", "--out", "A"}), here.path())
                .exit_code,
            0);
  ASSERT_EQ(palpa(session({"--seed", kShortTrial, "--trainee", "T008", "--out", "B"}), here.path())
                .exit_code,
            0);
  ASSERT_EQ(records({"add", "A"}, here).exit_code, 0);
  std::filesystem::rename(here / "A/session.palpa", here / "moved.palpa");
  std::filesystem::rename(here / "B/session.palpa", here / "A/session.palpa");
  const Outcome deleted = records({"delete", "--id", "T007", "--yes"}, here);
  EXPECT_EQ(deleted.exit_code, 1) << deleted.err;
  EXPECT_TRUE(says(deleted.out, "Still to be deleted")) << deleted.out;
  EXPECT_TRUE(says(deleted.out, "another session's evidence is in its place")) << deleted.out;
  EXPECT_TRUE(std::filesystem::exists(here / "A/session.palpa"));
  EXPECT_FALSE(std::filesystem::exists(here / "A/trials.csv")) << "names T007";
}

TEST(Records, WrongUsageIsNamed) {
  const Folder here;
  const auto complains = [&](std::vector<std::string> words, int code, const char* about) {
    const Outcome outcome = records(std::move(words), here);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, about)) << outcome.err;
  };
  ASSERT_EQ(records({"trainee", "add", "--id", "A"}, here).exit_code, 0);
  complains({"trainee", "add", "--id", "A"}, 2, "in the records already");
  complains({"trainee", "add", "--id", "Dr. Smith"}, 2, "pseudonym");
  complains({"trainee", "add", "--id", "B", "--keep-until", "soon"}, 2, "2027-03-01");
  complains({"trainee", "change", "--id", "B"}, 2, "is not in the records");
  complains({"delete", "--id", "B", "--yes"}, 2, "is not in the records");
  complains({"add", "nowhere"}, 1, "no such file");
  here.file("other.sqlite", "no database, and long enough");
  const Outcome other =
      palpa({"records", "trainee", "list", "--records", "other.sqlite"}, here.path());
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_TRUE(says(other.err, "is not a records file")) << other.err;
  const Outcome secret = palpa(
      {"records", "trainee", "list", "--records", "postgresql://me:geheim@host/db"}, here.path());
  EXPECT_EQ(secret.exit_code, 2);
  EXPECT_FALSE(says(secret.err, "geheim")) << secret.err;
}

TEST(Records, EveryFigureIsExplained) {
  const Folder here;
  const Outcome table = palpa({"records", "metrics"}, here.path());
  EXPECT_EQ(table.exit_code, 0) << table.err;
  for (const char* words :
       {"| path_length_mm | Length of the tip's path | mm | lower |", "does not apply when"})
    EXPECT_TRUE(says(table.out, words)) << words;
}

}  // namespace
}  // namespace palpa::cli_test
