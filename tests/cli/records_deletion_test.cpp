#include <gtest/gtest.h>

#include "apps/record/session_file.h"
#include "apps/record/store/delivery.h"
#include "apps/record/store/record_store.h"
#include "apps/runtime/clock.h"
#include "program.h"

/// A person who is deleted is gone from everywhere, and stays so.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;

constexpr char kGone[] = "Zq7x", kStays[] = "Other2";

/// Its evidence is there, and states whose it is.
bool hasBegun(const fs::path& evidence) {
  try {
    return says(record::SessionReader(evidence).info().session_json, kGone);
  } catch (const std::exception&) {
    return false;
  }
}
std::string uuidIn(const fs::path& evidence) { return record::SessionReader(evidence).info().uuid; }

class Deletion : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* id : {kGone, kStays})
      ASSERT_EQ(run({"records", "trainee", "add", "--consent", "--id", id}).exit_code, 0);
  }

  Outcome run(std::vector<std::string> words) const {
    words.insert(words.end(), {"--records", "records.sqlite"});
    return palpa(words, here_.path());
  }
  std::vector<std::string> session(const std::string& who, const std::string& out) const {
    return quickly({"squeeze", "--operator", "expert", "--trainee", who, "--out", out});
  }
  void train(const std::string& who, const std::string& out, bool recorded = true) const {
    const Outcome done = recorded ? run(session(who, out)) : palpa(session(who, out), here_.path());
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  Outcome remove() const {
    return run({"records", "delete", "--id", kGone, "--yes", "--home", "console"});
  }
  /// What an educator did at the console, as its folders show it.
  void useConsole() const {
    const std::string session = "console/sessions/20260301-120000-1a2b3c4d";
    train(kGone, session);
    here_.file(session + "/console.json", "{\"trainee\": \"" + std::string(kGone) + "\"}");
    here_.file(session + "/log.txt", "In the records of " + std::string(kGone) + "\n");
    for (const char* job : {"20260301-120001-00000001", "20260301-120001-00000002"})
      fs::create_directories(here_ / "console/jobs" / job);
    here_.file("console/jobs/20260301-120001-00000001/log.txt",
               "Written: report-" + std::string(kGone) + "/trainee.html\n");
    here_.file("console/jobs/20260301-120001-00000002/log.txt", "3 of 20\n");
    here_.file("console/refused.log",
               "a GET /api/trainees/" + std::string(kGone) + "/report 403 x\nb GET / 403 y\n");
  }
  void expectNoByteOf(const std::string& words) const {
    for (const std::string& name : here_.files())
      EXPECT_FALSE(says(name, words) || says(contentOf(here_ / name), words)) << name;
  }

  const Folder here_;
};

TEST_F(Deletion, LeavesNoByteOfThePerson) {
  train(kGone, "out/A");
  train(kStays, "out/B");
  train(kGone, "out/C", false);
  useConsole();
  here_.file("out/A/notes.txt", "of the educator");
  for (const char* film : {"out/A/room.mjpeg", "out/A/room.mjpeg.csv"}) here_.file(film, "a face");
  const std::string store = (here_ / "records.sqlite").string();
  record::PendingList(here_ / "state/palpa/pending")
      .note({uuidIn(here_ / "out/C/session.palpa"), here_ / "out/C/session.palpa", store});
  ASSERT_EQ(run({"report", "trainee", "--id", kGone, "--out", "out/talk"}).exit_code, 0);
  const std::string stays = contentOf(here_ / "out/B/trials.csv");

  const Outcome deleted = remove();
  EXPECT_EQ(deleted.exit_code, 0) << deleted.out << deleted.err;
  EXPECT_TRUE(says(deleted.out, "Kept, since no session wrote it: ")) << deleted.out;
  expectNoByteOf(kGone);
  expectNoByteOf("a face");
  EXPECT_EQ(contentOf(here_ / "out/A/notes.txt"), "of the educator");
  EXPECT_EQ(contentOf(here_ / "out/B/trials.csv"), stays);
  EXPECT_TRUE(fs::exists(here_ / "out/B/session.palpa"));
  for (const char* folder : {"out/C", "out/talk", "console/sessions/20260301-120000-1a2b3c4d",
                             "console/jobs/20260301-120001-00000001"})
    EXPECT_FALSE(fs::exists(here_ / folder)) << folder;
  EXPECT_TRUE(fs::exists(here_ / "console/jobs/20260301-120001-00000002/log.txt"));
  EXPECT_EQ(contentOf(here_ / "console/refused.log"), "b GET / 403 y\n");
}

TEST_F(Deletion, IsObeyedByABackupAndByEvidenceThatComesLate) {
  train(kGone, "out/A");
  train(kStays, "out/B");
  fs::copy_file(here_ / "records.sqlite", here_ / "copied.sqlite");
  ASSERT_EQ(run({"records", "backup", "--out", "saved.sqlite"}).exit_code, 0);
  fs::create_directories(here_ / "stick");
  fs::copy_file(here_ / "out/A/session.palpa", here_ / "stick/session.palpa");
  ASSERT_EQ(remove().exit_code, 0);

  fs::rename(here_ / "copied.sqlite", here_ / "records.sqlite");
  const Outcome list = run({"records", "trainee", "list"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_TRUE(says(list.err, "1 deleted trainee, 1 session")) << list.err;
  EXPECT_TRUE(says(list.out, "1 trainee in")) << list.out;
  const Outcome restored = palpa(
      {"records", "restore", "--from", "saved.sqlite", "--records", "new.sqlite"}, here_.path());
  EXPECT_EQ(restored.exit_code, 0) << restored.err;
  EXPECT_TRUE(says(restored.err, "1 deleted trainee, 1 session")) << restored.err;
  fs::remove(here_ / "saved.sqlite");

  const Outcome late = run({"records", "add", "stick"});
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_TRUE(says(late.err, "was deleted on request")) << late.err;
  fs::remove_all(here_ / "stick");
  expectNoByteOf(kGone);
}

TEST_F(Deletion, ThePseudonymMayBeGivenAnew) {
  train(kGone, "out/A");
  fs::create_directories(here_ / "stick");
  fs::copy_file(here_ / "out/A/session.palpa", here_ / "stick/session.palpa");
  ASSERT_EQ(remove().exit_code, 0);
  for (const std::string deleted = runtime::utcNow(); runtime::utcNow() <= deleted;)
    runtime::rest(std::chrono::milliseconds(20));
  ASSERT_EQ(run({"records", "trainee", "add", "--consent", "--id", kGone}).exit_code, 0);
  train(kGone, "out/D");
  EXPECT_TRUE(says(run({"records", "add", "stick"}).err, "was deleted on request"));
  const Outcome shown = run({"records", "show", "--id", kGone});
  EXPECT_TRUE(says(shown.out, "1 session, 1 trial")) << shown.out << shown.err;
}

TEST_F(Deletion, WhatCannotBeDeletedIsNamedAndDoneLater) {
  train(kGone, "out/A");
  train(kGone, "out/B");
  fs::remove(here_ / "out/A/report.html");
  fs::create_directories(here_ / "out/A/report.html/full");  // stands for what cannot be removed
  const Outcome deleted = remove();
  EXPECT_EQ(deleted.exit_code, 1);
  EXPECT_EQ(deleted.errLines(), 1) << deleted.err;
  EXPECT_TRUE(says(deleted.out, "out/A/report.html: cannot be removed")) << deleted.out;
  EXPECT_TRUE(says(deleted.err, "palpa records delete --left")) << deleted.err;
  EXPECT_FALSE(fs::exists(here_ / "out/A/trials.csv"));
  EXPECT_FALSE(fs::exists(here_ / "out/B"));
  fs::remove(here_ / "out/A/report.html/full");
  const Outcome again = run({"records", "delete", "--left", "--home", "console"});
  EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  EXPECT_FALSE(fs::exists(here_ / "out/A"));
  expectNoByteOf(kGone);
}

TEST_F(Deletion, EvidenceThatIsElsewhereIsNamedUntilItIsForgotten) {
  train(kGone, "out/A");
  const std::string uuid = uuidIn(here_ / "out/A/session.palpa");
  fs::remove_all(here_ / "out/A");
  const Outcome deleted = remove();
  EXPECT_EQ(deleted.exit_code, 1);
  EXPECT_TRUE(says(deleted.out, "out/A/session.palpa (session " + uuid + ")")) << deleted.out;
  EXPECT_EQ(run({"records", "delete", "--left"}).exit_code, 1);
  EXPECT_EQ(run({"records", "delete", "--forget", "nothing"}).exit_code, 2);
  EXPECT_EQ(run({"records", "delete"}).exit_code, 2);
  EXPECT_EQ(run({"records", "delete", "--forget", uuid}).exit_code, 0);
  EXPECT_EQ(run({"records", "delete", "--left"}).exit_code, 0);
}

TEST_F(Deletion, WaitsForTheEndOfASession) {
  std::vector<std::string> words = session(kGone, "out/B");
  words.insert(words.end(), {"--trials", "200", "--records", "records.sqlite"});
  Running long_one(words, here_.path());
  const record::PendingList pending(here_ / "state/palpa/pending");
  const auto begun = [&] {
    const auto waiting = pending.sessions();
    return !waiting.empty() && pending.isHeld(waiting[0].uuid) &&
           hasBegun(here_ / "out/B/session.palpa");
  };
  while (!begun() && !long_one.ended()) runtime::rest(std::chrono::milliseconds(20));
  ASSERT_FALSE(long_one.ended());
  const Outcome refused = remove();
  EXPECT_EQ(refused.exit_code, 2) << refused.out;
  EXPECT_TRUE(says(refused.err, "still going on")) << refused.err;
  long_one.kill();
  const Outcome deleted = remove();
  EXPECT_EQ(deleted.exit_code, 0) << deleted.out << deleted.err;
  EXPECT_FALSE(fs::exists(here_ / "out/B"));
}

}  // namespace
}  // namespace palpa::cli_test
