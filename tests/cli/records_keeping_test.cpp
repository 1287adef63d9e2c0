#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "apps/record/session_file.h"
#include "apps/record/store/delivery.h"
#include "apps/record/store/migrations.h"
#include "apps/record/store/record_store.h"
#include "apps/runtime/clock.h"
#include "program.h"
#include "tests/link/loopback_lrs.h"
#include "tests/link/trials.h"
#include "tests/support/counts.h"

/// Records kept, shown, handed on, brought in at a session's end.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;
using link_test::sessionOf;
using link_test::trialOf;

/// Two people: A has agreed to everything, B to nothing; a session of three trials each, A's second
/// is simulated.
class RecordsKept : public testing::Test {
 protected:
  void SetUp() override {
    record::RecordStore store(file());
    store.addTrainee(link_test::person("A"));
    store.addTrainee(link_test::person("B", false));
    for (int i = 1; i <= 3; ++i) {
      store.addTrial(sessionOf("A", 1), trialOf(i, 100 * i));
      store.addTrial(sessionOf("A", 2, true), trialOf(i));
      store.addTrial(sessionOf("B", 3), trialOf(i));
    }
  }

  std::string file() const { return (here_ / "records.sqlite").string(); }
  Outcome run(std::vector<std::string> words) const {
    words.insert(words.begin(), "records");
    words.insert(words.end(), {"--records", "records.sqlite"});
    return palpa(words, here_.path());
  }

  const Folder here_;
};

TEST_F(RecordsKept, BackedUpAndRestored) {
  const Outcome saved = run({"backup", "--out", "saved.sqlite"});
  EXPECT_EQ(saved.exit_code, 0) << saved.err;
  EXPECT_EQ(run({"backup", "--out", "saved.sqlite"}).exit_code, 2);  // never overwrites
  const std::string bytes = contentOf(here_ / "saved.sqlite");
  fs::permissions(here_ / "saved.sqlite", fs::perms::owner_read);
  const Outcome restored = palpa(
      {"records", "restore", "--from", "saved.sqlite", "--records", "new.sqlite"}, here_.path());
  EXPECT_EQ(restored.exit_code, 0) << restored.err;
  EXPECT_EQ(record::RecordStore((here_ / "new.sqlite").string()).trials().size(), 9u);
  EXPECT_EQ(contentOf(here_ / "saved.sqlite"), bytes);
  const Outcome again = palpa(
      {"records", "restore", "--from", "saved.sqlite", "--records", "new.sqlite"}, here_.path());
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_TRUE(says(again.err, "holds records already")) << again.err;
  EXPECT_EQ(palpa({"records", "restore", "--from", "nowhere.sqlite", "--records", "third.sqlite"},
                  here_.path())
                .exit_code,
            2);
  EXPECT_FALSE(fs::exists(here_ / "nowhere.sqlite"));
  for (const std::string& name : here_.files()) EXPECT_FALSE(says(name, ".part")) << name;
}

TEST_F(RecordsKept, ADamagedBackupIsNamed) {
  ASSERT_EQ(run({"backup", "--out", "saved.sqlite"}).exit_code, 0);
  fs::resize_file(here_ / "saved.sqlite", fs::file_size(here_ / "saved.sqlite") / 2);
  const Outcome restored = palpa(
      {"records", "restore", "--from", "saved.sqlite", "--records", "new.sqlite"}, here_.path());
  EXPECT_EQ(restored.exit_code, 1);
  EXPECT_TRUE(says(restored.err, "is damaged")) << restored.err;
}

TEST_F(RecordsKept, MigrationSaysFromWhichVersion) {
  EXPECT_TRUE(says(run({"migrate"}).out, "the newest that this program knows"));
  {
    const auto old = record::connect((here_ / "old.sqlite").string());
    record::migrate(*old, 0);
  }
  const Outcome brought = palpa({"records", "migrate", "--records", "old.sqlite"}, here_.path());
  EXPECT_EQ(brought.exit_code, 0) << brought.err;
  EXPECT_TRUE(says(brought.out, "from version 0 to " + std::to_string(record::newestSchema())))
      << brought.out;
}

TEST_F(RecordsKept, APersonIsShownInPlainWords) {
  const Outcome shown = run({"show", "--id", "A"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  for (const char* words :
       {"Trainee A, novice, left-handed", "2 sessions, 6 trials",
        "use in studies: agreed on 2026-03-01", "session 2, 2026-03-01T10:00:00Z: paracentesis at",
        "simulated", "trial 2 (scored): success, 31.5 s, total penalty 200.0"})
    EXPECT_TRUE(says(shown.out, words)) << words << "\n" << shown.out;
  EXPECT_EQ(run({"show", "--id", "C"}).exit_code, 2);
}

TEST_F(RecordsKept, WhoseTimeIsOverIsListedAndDeletedOnlyWhenMeant) {
  EXPECT_TRUE(says(run({"overdue", "--date", "2027-03-01"}).out, "0 trainees"));
  EXPECT_TRUE(says(run({"overdue", "--date", "2027-03-02"}).out, "2 trainees"));
  EXPECT_EQ(run({"overdue", "--date", "2027-03-02", "--delete"}).exit_code, 2);
  EXPECT_EQ(record::RecordStore(file()).trainees().size(), 2u);
  const Outcome deleted = run({"overdue", "--date", "2027-03-02", "--delete", "--yes"});
  EXPECT_EQ(deleted.exit_code, 1) << "their evidence is on another computer";
  EXPECT_EQ(deleted.errLines(), 1) << deleted.err;
  EXPECT_TRUE(says(deleted.out, "Still to be deleted where it was made: /home/somebody/out"))
      << deleted.out;
  EXPECT_TRUE(record::RecordStore(file()).trainees().empty());
  EXPECT_EQ(run({"overdue", "--date", "soon"}).exit_code, 2);
}

TEST_F(RecordsKept, ExportsForAStudyHaveOnlyWhoAgreed) {
  const Outcome all = run({"export", "--all", "--out", "all", "--format", "csv"}),
                study =
                    run({"export", "--all", "--research", "--out", "study", "--format", "json"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_TRUE(says(all.out, "2 trainees, 3 sessions (1 simulated), 9 trials")) << all.out;
  EXPECT_TRUE(says(study.out, "Left out: 1 trainee who has not agreed to use in studies"))
      << study.out;
  EXPECT_TRUE(says(study.out, "1 trainee, 2 sessions")) << study.out;
  const std::string trials = contentOf(here_ / "all/trials.csv");
  EXPECT_EQ(std::count(trials.begin(), trials.end(), '\n'), 10);
  EXPECT_FALSE(fs::exists(here_ / "all/records.json"));
  EXPECT_FALSE(fs::exists(here_ / "study/trials.csv"));
  for (const char* file : {"all/dictionary.csv", "all/dictionary.md", "study/records.json"})
    EXPECT_FALSE(says(contentOf(here_ / file), "/home/")) << file;
  EXPECT_TRUE(says(run({"export", "--id", "B", "--out", "b"}).out, "1 trainee, 1 session"));
  EXPECT_EQ(run({"export", "--out", "c"}).exit_code, 2);
  EXPECT_EQ(run({"export", "--all", "--id", "A", "--out", "c"}).exit_code, 2);
}

TEST_F(RecordsKept, ALearningRecordStoreIsTold) {
  link_test::LoopbackLrs lrs;
  lrs.start();
  const std::vector<std::string> tell{"xapi", "--to", lrs.url(), "--all", "--user", "teacher"};
  EXPECT_TRUE(says(run(tell).err, "PALPA_XAPI_PASSWORD"));
  ::setenv("PALPA_XAPI_PASSWORD", "geheim", 1);
  const Outcome refused = run(tell);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_TRUE(says(refused.err, "refuses user or password")) << refused.err;
  EXPECT_FALSE(says(refused.out + refused.err, "geheim"));
  ::setenv("PALPA_XAPI_PASSWORD", "secret", 1);
  const Outcome told = run(tell);
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_TRUE(says(told.out, "3 statements delivered, 0 there already, 0 waiting")) << told.out;
  EXPECT_TRUE(says(told.out, "1 trainee who has not agreed to keeping training records"))
      << told.out;
  EXPECT_TRUE(says(told.out, "3 trials of simulated sessions")) << told.out;
  lrs.stop();
  const Outcome away =
      run({"xapi", "--to", lrs.url(), "--id", "A", "--simulated", "--user", "teacher"});
  EXPECT_EQ(away.exit_code, 1);
  EXPECT_TRUE(says(away.err, "the same command sends it later")) << away.err;
  lrs.start();
  EXPECT_TRUE(
      says(run({"xapi", "--to", lrs.url(), "--user", "teacher"}).out, "3 statements delivered"));
  const Outcome deleted = run({"delete", "--id", "A", "--yes"});
  EXPECT_TRUE(
      says(deleted.out,
           "6 statements will be taken back there by: palpa records xapi --to " + lrs.url()))
      << deleted.out;
  EXPECT_EQ(run({"xapi", "--to", lrs.url(), "--user", "teacher"}).exit_code, 0);
  ::unsetenv("PALPA_XAPI_PASSWORD");
  const auto stored = lrs.stored();
  EXPECT_EQ(
      std::count_if(stored.begin(), stored.end(), [](const auto& s) { return s.second.voided; }),
      6);
  EXPECT_TRUE(lrs.complaints().empty()) << lrs.complaints().front();
  EXPECT_TRUE(says(run({"xapi", "--to", "http://lrs.example/xapi"}).err, "--insecure"));
}

/// The task that computes fastest.
std::vector<std::string> quick(std::vector<std::string> more) {
  more.insert(more.begin(), {"squeeze", "--operator", "expert"});
  return quickly(more);
}

class SessionIntoRecords : public testing::Test {
 protected:
  void SetUp() override { record::RecordStore(file()).addTrainee(link_test::person("T007")); }
  std::string file() const { return (here_ / "records.sqlite").string(); }
  std::size_t trials() const {
    return record::RecordStore(file()).trials({.trainee = "T007"}).size();
  }
  const Folder here_;
};

TEST_F(SessionIntoRecords, FinishedTrialsArrive) {
  const Outcome done = palpa(
      quick({"--trials", "2", "--trainee", "T007", "--records", "records.sqlite", "--out", "A"}),
      here_.path());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(says(done.out, "In the records of T007: 2 trials")) << done.out;
  EXPECT_EQ(trials(), 2u);
  EXPECT_TRUE(says(palpa({"records", "deliver"}, here_.path()).out, "Nothing waits"));
  const Outcome exported = palpa(
      {"records", "export", "--all", "--out", "data", "--records", "records.sqlite"}, here_.path());
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  for (const fs::directory_entry& entry : fs::directory_iterator(here_ / "data"))
    EXPECT_FALSE(says(contentOf(entry.path()), here_.path().string())) << entry.path();
}

TEST_F(SessionIntoRecords, OfEveryTask) {
  std::vector<std::vector<std::string>> tasks{
      {"subclavian"}, {"search"}, {"palpation", "--preset", "prostate"}};
  tasks.resize(test::counted(2u, 3u));
  std::size_t sessions = 0;
  for (std::vector<std::string> words : tasks) {
    for (const char* word : {"--operator", "expert", "--seed", kShortTrial, "--trainee", "T007",
                             "--records", "records.sqlite", "--out", "A"})
      words.emplace_back(word);
    words.back() += words.front();
    const Outcome done = palpa(quickly(words), here_.path());
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(record::RecordStore(file()).sessions("T007").size(), ++sessions)
        << words.front() << done.err;
  }
}

TEST_F(SessionIntoRecords, NobodyIsRecordedUnlessOneSaysSo) {
  ASSERT_EQ(palpa(quick({"--trainee", "T007", "--out", "A"}), here_.path()).exit_code, 0);
  EXPECT_EQ(trials(), 0u);
  const Outcome stranger = palpa(
      quick({"--trainee", "T008", "--records", "records.sqlite", "--out", "B"}), here_.path());
  EXPECT_EQ(stranger.exit_code, 2);
  EXPECT_TRUE(says(stranger.err, "palpa records trainee add --id T008")) << stranger.err;
  EXPECT_FALSE(fs::exists(here_ / "B"));
  ::setenv("PALPA_TEST_RECORDS", file().c_str(), 1);
  const Outcome nobody = palpa(quick({"--out", "C"}), here_.path()),
                named = palpa(quick({"--trainee", "T007", "--out", "D"}), here_.path());
  ::unsetenv("PALPA_TEST_RECORDS");
  EXPECT_EQ(nobody.exit_code, 0) << nobody.err;
  EXPECT_TRUE(says(nobody.out, "nobody's")) << nobody.out;
  EXPECT_EQ(named.exit_code, 0) << named.err;
  EXPECT_EQ(trials(), 1u);
}

TEST_F(SessionIntoRecords, RecordsThatAreAwayDoNotStopASession) {
  const Outcome done = palpa(quick({"--trainee", "T007", "--records",
                                    "postgresql://nobody@127.0.0.1:1/palpa", "--out", "A"}),
                             here_.path());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.errLines(), 2) << done.err;  // before and after
  EXPECT_TRUE(says(done.err, "palpa records deliver sends it later")) << done.err;
  const auto noted = record::PendingList(here_ / "state/palpa/pending").sessions();
  ASSERT_EQ(noted.size(), 1u);
  record::PendingList(here_ / "state/palpa/pending")
      .note({noted[0].uuid, noted[0].evidence,
             file()});  // as if the server were back under that address
  EXPECT_TRUE(says(palpa({"records", "deliver"}, here_.path()).out, "1 trial added"));
  EXPECT_EQ(trials(), 1u);
}

TEST_F(SessionIntoRecords, AKilledSessionIsDeliveredLater) {
  Running session_running(
      quick({"--trials", "200", "--trainee", "T007", "--records", "records.sqlite", "--out", "A"}),
      here_.path());
  const auto ended = [&] {
    try {
      const auto all = record::SessionReader(here_ / "A/session.palpa").trials();
      return std::count_if(all.begin(), all.end(),
                           [](const record::RecordedTrial& t) { return t.ended; });
    } catch (const std::exception&) {  // not there yet
      return std::ptrdiff_t{0};
    }
  };
  while (ended() < 2 && !session_running.ended())
    runtime::SteadyClock().sleepUntil(20 * runtime::kMillisecond);
  EXPECT_TRUE(says(palpa({"records", "deliver"}, here_.path()).out, "is still going on"));
  session_running.kill();
  const auto whole = ended();
  ASSERT_GE(whole, 2);
  ASSERT_LT(whole, 200);
  const Outcome sent = palpa({"records", "deliver"}, here_.path());
  EXPECT_EQ(sent.exit_code, 0) << sent.out << sent.err;
  EXPECT_EQ(trials(), static_cast<std::size_t>(whole));
}

TEST_F(SessionIntoRecords, OneThatCannotBeSentKeepsNoOtherBack) {
  record::PendingList pending(here_ / "state/palpa/pending");
  pending.note({"0", here_ / "gone/session.palpa", file()});
  ASSERT_EQ(palpa(quick({"--trainee", "T007", "--out", "A"}), here_.path()).exit_code, 0);
  pending.note({"1", here_ / "A/session.palpa", file()});
  const Outcome first = palpa({"records", "deliver"}, here_.path());
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_TRUE(says(first.out, "Session 0 waits on")) << first.out;
  EXPECT_EQ(trials(), 1u);
  EXPECT_EQ(palpa({"records", "deliver", "--forget", "0"}, here_.path()).exit_code, 0);
  EXPECT_EQ(palpa({"records", "deliver", "--forget", "0"}, here_.path()).exit_code, 2)
      << "nothing of that name waits";
}

}  // namespace
}  // namespace palpa::cli_test
