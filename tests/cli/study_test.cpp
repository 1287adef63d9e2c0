#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "apps/record/session_file.h"
#include "apps/record/store/pending.h"
#include "apps/record/store/study_store.h"
#include "apps/station/sha256.h"
#include "program.h"

/// Studies, as an educator runs them.
namespace palpa::cli_test {
namespace {

using nlohmann::json;

const std::string kAssets = PALPA_SOURCE_DIR "/assets";

json protocolText() {
  const std::string task = kAssets + "/tasks/paracentesis.json";
  return {{"version", 1},
          {"id", "small"},
          {"title", "A small study"},
          {"source", "made up"},
          {"groups", {{{"name", "novice"}, {"means", "new"}}, {{"name", "experienced"}, {"means", "old"}}}},
          {"conditions", {{{"name", "FF"}, {"means", "felt"}}, {{"name", "NO"}, {"means", "not felt"}, {"sets", {{"force_feedback", false}}}}}},
          {"allocation", {{"conditions", {"FF", "NO"}}, {"block", 2}}},
          {"trial_seed", 100},
          {"sessions", {{{"name", "only"}, {"blocks", {{{"name", "trials"}, {"task", task}, {"trials", 2}, {"condition", "drawn"}}}}, {"questionnaire", kAssets + "/protocols/questionnaires/paracentesis_pilot.json"}}}}};
}

class Study : public testing::Test {
 protected:
  Study() { ::setenv("XDG_STATE_HOME", here.path().c_str(), 1); }   // what waits is kept there
  ~Study() override { ::unsetenv("XDG_STATE_HOME"); }

  Outcome run(const std::vector<std::string>& more, const std::string& records = "records.sqlite") {
    std::vector<std::string> words{"study", "run", "--protocol", "protocol.json", "--records", records, "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return palpa(words, here.path());
  }
  Outcome runTrainee(std::vector<std::string> more = {}, const std::string& records = "records.sqlite") {
    for (const char* word : {"--trainee", "T001", "--operator", "expert", "--fast", "--no-views", "--quiet"}) more.emplace_back(word);
    return run(more, records);
  }
  Outcome status() { return palpa({"study", "status", "--protocol", "protocol.json", "--records", "records.sqlite"}, here.path()); }
  void addTrainee(const std::string& id, const std::string& group, bool research = true) {
    std::vector<std::string> words{"records", "trainee", "add", "--id", id, "--group", group, "--consent", "--records", "records.sqlite"};
    if (research) words.emplace_back("--research");
    ASSERT_EQ(palpa(words, here.path()).exit_code, 0);
  }
  record::RecordStore store() { return record::RecordStore((here / "records.sqlite").string()); }

  const Folder here;
  const std::string protocol = here.file("protocol.json", protocolText().dump());
  const std::string answers = here.file("answers.json", R"({"useful": 4, "needed": 5, "skin_real": 2, "bone_real": 3, "seen_real": 3, "learned": 4, "tiring": 1, "remarks": "fine"})");
};

TEST_F(Study, LeadsThroughASessionAndItsQuestions) {
  addTrainee("T001", "novice");
  const Outcome first = runTrainee();
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(says(first.out, "2 trials kept in the records")) << first.out;
  EXPECT_TRUE(says(first.out, "Not finished: the same command goes on")) << first.out;   // nobody answers
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
  EXPECT_TRUE(says(wrong.err, "\"useful\" cannot be taken: the answer is a whole number from 1 to 5")) << wrong.err;
  here.file("some.json", R"({"useful": 4})");
  EXPECT_TRUE(says(runTrainee({"--answers", "some.json"}).out, "Not finished"));
  EXPECT_TRUE(says(status().out, "questionnaire: 7 open"));
  const Outcome last = runTrainee({"--answers", "answers.json"});
  EXPECT_TRUE(says(last.out, "Finished: all of small")) << last.out;
  EXPECT_TRUE(says(runTrainee().out, "Finished: all of small"));   // and no trial more
  EXPECT_EQ(records.trials().size(), 2u);
  EXPECT_EQ(record::StudyStore(records).answers("small", "T001").size(), 8u);
}

/// Whatever the moment: nothing that ended is lost, nothing is done twice.
TEST_F(Study, GoesOnWhereItWasKilled) {
  addTrainee("T001", "novice");
  for (int tries = 0; tries < 3; ++tries) {
    Running running({"study", "run", "--protocol", "protocol.json", "--records", "records.sqlite", "--out", "out", "--trainee", "T001", "--operator", "novice", "--fast", "--no-views", "--quiet"}, here.path());
    const auto evidence = here / "out/T001";
    for (int wait = 0; wait < 600 && !running.ended(); ++wait) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      if (std::filesystem::exists(evidence) && wait > 100 + 60 * tries) break;
    }
    tries % 2 ? static_cast<void>(running.interrupt()) : running.kill();
  }
  const Outcome on = runTrainee();
  EXPECT_EQ(on.exit_code, 0) << on.err;
  auto records = store();
  std::set<std::uint64_t> seeds;
  for (const auto& t : records.trials({.study = "small"}))
    if (t.trial.outcome != "void") EXPECT_TRUE(seeds.insert(t.trial.seed).second) << "done twice";
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
  EXPECT_EQ(unknown.exit_code, 1);   // nobody can say in which condition
  EXPECT_TRUE(says(unknown.err, "cannot be reached")) << unknown.err;
  const Outcome first = runTrainee();
  EXPECT_TRUE(says(first.out, "Session 1 of 2 is done; the next one can begin")) << first.out << first.err;

  // As if the records had been on that server, which is gone now.
  const auto copy = [&](const std::string& url) { return here / ("palpa/studies/small-T001-" + station::sha256(url).substr(0, 12) + ".json"); };
  std::filesystem::rename(copy("records.sqlite"), copy(away));
  const Outcome alone = runTrainee({"--answers", "answers.json"}, away);
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_TRUE(says(alone.out, "The records cannot be reached")) << alone.out;
  EXPECT_TRUE(says(alone.out, "1 trial kept on this station")) << alone.out;
  EXPECT_TRUE(says(alone.out, "Finished")) << alone.out;
  EXPECT_EQ(store().trials().size(), 1u);

  const record::PendingList pending(here / "palpa/pending");
  ASSERT_EQ(pending.sessions().size(), 1u);
  record::PendingList(here / "palpa/pending").note({pending.sessions()[0].uuid, pending.sessions()[0].evidence, "records.sqlite"});
  std::filesystem::rename(copy(away), copy("records.sqlite"));
  const Outcome back = runTrainee();
  EXPECT_TRUE(says(back.out, "Finished")) << back.out << back.err;
  EXPECT_TRUE(pending.sessions().empty());
  auto records = store();
  EXPECT_EQ(records.trials().size(), 2u);
  EXPECT_EQ(record::StudyStore(records).answers("small", "T001").size(), 8u);
}

TEST_F(Study, RefusesWhoCannotTakePart) {
  const auto refused = [&](const char* words) {
    const Outcome outcome = runTrainee();
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, words)) << outcome.err;
  };
  refused("is not in the records");
  addTrainee("T001", "novice", false);
  refused("has not agreed to studies");
  ASSERT_EQ(palpa({"records", "trainee", "change", "--id", "T001", "--research", "--group", "surgeon", "--records", "records.sqlite"}, here.path()).exit_code, 0);
  refused("none of the study's");
  ASSERT_EQ(palpa({"records", "trainee", "change", "--id", "T001", "--group", "novice", "--records", "records.sqlite"}, here.path()).exit_code, 0);
  json text = protocolText();
  text["barred"] = {"T001"};
  here.file("protocol.json", text.dump());
  refused("barred by the protocol");
  // An expert whose trials made the task's optimal path.
  json path = json::parse(contentOf(kAssets + "/tasks/paracentesis_expert_path.json")), task = json::parse(contentOf(kAssets + "/tasks/paracentesis.json"));
  path["experts"].push_back("T001");
  here.file("paracentesis_expert_path.json", path.dump());
  task["materials"] = kAssets + "/materials/needle.json";
  here.file("task.json", task.dump());
  text = protocolText();
  text["sessions"][0]["blocks"][0]["task"] = "task.json";
  here.file("protocol.json", text.dump());
  refused("made the optimal path");
  text["conditions"][0]["name"] = "GG";
  here.file("protocol.json", text.dump());
  refused("\"FF\", which is none of the protocol's conditions");
  EXPECT_TRUE(record::StudyStore(*std::make_unique<record::RecordStore>((here / "records.sqlite").string())).enrolments("small").empty());
}

TEST_F(Study, AChangedProtocolIsAnotherStudy) {
  addTrainee("T001", "novice");
  ASSERT_EQ(runTrainee({"--answers", "answers.json"}).exit_code, 0);
  json text = protocolText();
  text["trial_seed"] = 5;
  here.file("protocol.json", text.dump());
  const Outcome changed = runTrainee();
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_TRUE(says(changed.err, "by another protocol file")) << changed.err;
}

TEST_F(Study, TellsNoConditionWhereItIsBlind) {
  json text = protocolText();
  text["blind"] = {"educator"};
  text["conditions"][0]["means"] = "with the secret";
  text["conditions"][1]["means"] = "without the secret";
  here.file("protocol.json", text.dump());
  addTrainee("T001", "novice");
  const Outcome blind = runTrainee({"--answers", "answers.json"});
  ASSERT_EQ(blind.exit_code, 0) << blind.err;
  for (const std::string& said : {blind.out, status().out}) EXPECT_FALSE(says(said, "secret") || says(said, "FF") || says(said, "NO ")) << said;
  EXPECT_TRUE(says(status().out, "novice         1 place given; balanced again after 1 more")) << status().out;
}

/// The same cohort, whoever works on it; each trial by somebody a little better.
TEST_F(Study, VirtualTraineesFillAProtocol) {
  const auto simulate = [&](const std::string& records, const std::string& workers, const std::string& out) {
    return palpa({"study", "run", "--protocol", "protocol.json", "--simulate", "2", "--learning", "learners.json", "--seed", "3", "--workers", workers, "--records", records, "--out", out, "--quiet"}, here.path());
  };
  const auto group = [](const char* name, double start) {
    return json{{"name", name}, {"subjects", 9}, {"start", start}, {"start_sd", 0.05}, {"asymptote", 1}, {"asymptote_sd", 0}, {"rate_per_trial", 0.3}, {"rate_sd", 0.1}};
  };
  here.file("learners.json", json{{"version", 1}, {"id", "few"}, {"title", "Few"}, {"planted", "nothing much"}, {"engine", "needle"}, {"from", kAssets + "/operators/novice.json"}, {"to", kAssets + "/operators/expert.json"},
                                  {"groups", {group("novice", 0.5), group("experienced", 0.9)}}, {"conditions", {{{"name", "FF"}, {"rate_times", 1}}, {{"name", "NO"}, {"rate_times", 0.5}}}}}
                                 .dump());
  const Outcome two = simulate("two.sqlite", "2", "A"), one = simulate("one.sqlite", "1", "B");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_TRUE(says(two.out, "Simulated: 4 trainees with 2 trials each")) << two.out;
  EXPECT_EQ(simulate("two.sqlite", "2", "A").exit_code, 0);   // all is done: nothing is added
  record::RecordStore a((here / "two.sqlite").string()), b((here / "one.sqlite").string());
  const auto trials = a.trials({.study = "small"}), same = b.trials({.study = "small"});
  ASSERT_EQ(trials.size(), 8u);
  ASSERT_EQ(same.size(), 8u);
  std::map<std::string, int> conditions;
  std::set<double> totals;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(trials[i].trial.score_json, same[i].trial.score_json) << i;
    EXPECT_TRUE(trials[i].session.simulated);
    const json facts = json::parse(trials[i].session.facts_json);
    EXPECT_EQ(facts.at("operator"), "learner");
    EXPECT_EQ(facts.at("simulated"), true);
    ++conditions[facts.at("study").at("group").get<std::string>() + facts.at("study").at("condition").get<std::string>()];
    totals.insert(trials[i].trial.metric("total"));
  }
  EXPECT_EQ(conditions.size(), 4u);   // balanced: one of two of each group in each condition
  EXPECT_EQ(totals.size(), 8u);       // no two people's trials are alike
  for (const auto& e : record::StudyStore(a).enrolments("small")) EXPECT_TRUE(e.simulated);
  for (const auto& t : a.trainees()) EXPECT_EQ(t.experience, "simulated");
}

TEST_F(Study, WrongUsageIsNamed) {
  const auto complains = [&](const std::vector<std::string>& more, const char* about) {
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, about)) << outcome.err;
  };
  complains({}, "needs --trainee or --simulate");
  complains({"--simulate"}, "needs --learning");
  complains({"--trainee", "T001", "--learning", "x.json"}, "goes with --simulate only");
  complains({"--trainee", "T001", "--simulate", "2"}, "one of them only");
  complains({"--trainee", "Dr. Smith"}, "pseudonym");
  complains({"--simulate", "2", "--learning", "none.json"}, "cannot be read");
}

}  // namespace
}  // namespace palpa::cli_test
