#include <gtest/gtest.h>

#include <set>

#include "anatomy/base/sha256.h"
#include "apps/record/store/delivery.h"
#include "apps/record/store/study_store.h"
#include "apps/runtime/clock.h"
#include "study_bench.h"

/// Studies, as an educator runs them: one trainee's way, whatever interrupts it.
namespace palpa::cli_test {
namespace {

using nlohmann::json;

TEST_F(Study, LeadsThroughASessionAndItsQuestions) {
  addTrainee("T001", "novice");
  const Outcome first = runTrainee();
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(says(first.out, "2 trials kept in the records")) << first.out;
  EXPECT_TRUE(says(first.out, "Not finished: the same command continues"))
      << first.out;  // nobody answers
  EXPECT_TRUE(says(status().out, "questionnaire: 8 open")) << status().out;

  auto records = store();
  const auto trials = records.trials({.trainee = "T001", .study = "small"});
  ASSERT_EQ(trials.size(), 2u);
  const auto enrolled = record::StudyStore(records).enrolment("small", "T001");
  ASSERT_TRUE(enrolled);
  const json study = json::parse(trials[0].session.facts_json).at("study");
  EXPECT_EQ(study.at("id"), "small");
  EXPECT_EQ(study.at("group"), "novice");
  EXPECT_EQ(study.at("condition"), enrolled->condition);
  EXPECT_EQ(study.at("block"), "trials");
  EXPECT_EQ(study.at("protocol_sha256").get<std::string>().size(), 64u);
  EXPECT_EQ(trials[0].session.slot, 1);
  EXPECT_TRUE(trials[0].session.simulated);
  for (const auto& t : trials) EXPECT_EQ(t.trial.force_feedback, enrolled->condition == "FF");
  EXPECT_EQ(trials[0].trial.seed + 1, trials[1].trial.seed);

  here.file("wrong.json", R"({"useful": 6})");
  const Outcome wrong = runTrainee({"--answers", "wrong.json"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_TRUE(
      says(wrong.err, "\"useful\" cannot be accepted: the answer is a whole number from 1 to 5"))
      << wrong.err;
  here.file("some.json", R"({"useful": 4})");
  EXPECT_TRUE(says(runTrainee({"--answers", "some.json"}).out, "Not finished"));
  EXPECT_TRUE(says(status().out, "questionnaire: 7 open"));
  const Outcome last = runTrainee({"--answers", "answers.json"});
  EXPECT_TRUE(says(last.out, "Finished: all of small")) << last.out;
  EXPECT_TRUE(says(runTrainee().out, "Finished: all of small"));  // and no trial more
  EXPECT_EQ(records.trials().size(), 2u);
  EXPECT_EQ(record::StudyStore(records).answers("small", "T001").size(), 8u);

  // A page for whoever must not know the condition.
  std::vector<std::string> report{"report", "trainee", "--id",      "T001",
                                  "--out",  "R",       "--records", "records.sqlite"};
  EXPECT_EQ(palpa(report, here.path()).exit_code, 0);
  report.insert(report.end(), {"--leave-out-study", "small"});
  const Outcome blind = palpa(report, here.path());
  EXPECT_EQ(blind.exit_code, 2);
  EXPECT_TRUE(says(blind.err, "has no trials")) << blind.err;
  report.insert(report.end(), {"--leave-out-study", "another"});
  EXPECT_TRUE(says(palpa(report, here.path()).err, "has no trials"));
}

/// Whatever the moment: nothing that ended is lost, nothing is done twice.
TEST_F(Study, GoesOnWhereItWasKilled) {
  addTrainee("T001", "novice");
  runtime::SteadyClock clock;
  for (int tries = 0; tries < 3; ++tries) {
    Running running({"study", "run", "--protocol", "protocol.json", "--records", "records.sqlite",
                     "--out", "out", "--station", quickStation("virtual_bench.json"), "--trainee",
                     "T001", "--operator", "novice", "--fast", "--no-views", "--quiet"},
                    here.path());
    const auto evidence = here / "out/T001";
    for (int wait = 0; wait < 600 && !running.ended(); ++wait) {
      clock.sleepUntil(clock.now() + 10 * runtime::kMillisecond);
      if (std::filesystem::exists(evidence) && wait > 100 + 60 * tries) break;
    }
    tries % 2 ? static_cast<void>(running.interrupt()) : running.kill();
  }
  const Outcome on = runTrainee();
  EXPECT_EQ(on.exit_code, 0) << on.err;
  auto records = store();
  std::set<std::uint64_t> seeds;
  for (const auto& t : records.trials({.study = "small"})) {
    if (t.trial.outcome == "void") continue;
    EXPECT_TRUE(seeds.insert(t.trial.seed).second) << "done twice";
  }
  EXPECT_EQ(seeds.size(), 2u);
  EXPECT_EQ(record::StudyStore(records).placesGiven("small", "novice"), 1);
  EXPECT_TRUE(says(status().out, "questionnaire")) << status().out;
}

/// The trials wait here while the records are away; what this station noted leads on.
TEST_F(Study, GoesOnWithoutItsRecords) {
  json text = protocolText();
  const json questionnaire = text["sessions"][0]["questionnaire"];
  text["sessions"][0].erase("questionnaire");
  text["sessions"][0]["blocks"][0]["trials"] = 1;
  text["sessions"].push_back(text["sessions"][0]);
  text["sessions"][1]["name"] = "later";
  text["sessions"][1]["questionnaire"] = questionnaire;
  here.file("protocol.json", text.dump());
  addTrainee("T001", "novice");
  const std::string away = "postgresql://127.0.0.1:1/palpa";
  const Outcome unknown = runTrainee({}, away);
  EXPECT_EQ(unknown.exit_code, 1);  // nobody can say in which condition
  EXPECT_TRUE(says(unknown.err, "cannot be reached")) << unknown.err;
  const Outcome first = runTrainee();
  EXPECT_TRUE(says(first.out, "Session 1 of 2 is done; the next one can begin"))
      << first.out << first.err;

  // As if the records had been on that server, which is gone now.
  const auto copy = [&](const std::string& url) {
    return here / ("palpa/studies/small-T001-" + sha256(url).substr(0, 12) + ".json");
  };
  const std::string records_here = (here / "records.sqlite").string();
  std::filesystem::rename(copy(records_here), copy(away));
  const Outcome alone = runTrainee({"--answers", "answers.json"}, away);
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_TRUE(says(alone.out, "The records cannot be reached")) << alone.out;
  EXPECT_TRUE(says(alone.out, "1 trial kept on this station")) << alone.out;
  EXPECT_TRUE(says(alone.out, "Finished")) << alone.out;
  EXPECT_EQ(store().trials().size(), 1u);

  const record::PendingList pending(here / "palpa/pending");
  ASSERT_EQ(pending.sessions().size(), 1u);
  record::PendingList(here / "palpa/pending")
      .note({pending.sessions()[0].uuid, pending.sessions()[0].evidence, records_here});
  std::filesystem::rename(copy(away), copy(records_here));
  const Outcome back = runTrainee();
  EXPECT_TRUE(says(back.out, "Finished")) << back.out << back.err;
  EXPECT_TRUE(pending.sessions().empty());
  auto records = store();
  EXPECT_EQ(records.trials().size(), 2u);
  EXPECT_EQ(record::StudyStore(records).answers("small", "T001").size(), 8u);
}

}  // namespace
}  // namespace palpa::cli_test
